#include "apps/instrument/led_watch.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/rig/open_objects.h"
#include "apps/simulation/virtual_shots.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// The small rig's first LED stands `off_mm` from where the rig states it.
Measurement measured_with_led_off(double off_mm, double std_mm) {
  SmallRig files;
  files.keep_shots("PE_cube");
  const Rig stated = read_rig(files.rig());
  Rig other = stated;
  other.scene.lights[0].led()->led.position_mm.x() += off_mm;
  const ObjectScenes scenes = open_objects(stated);
  const ObjectScenes true_scenes = open_objects(other);
  const VirtualShots shots(other, true_scenes, {.noise = true});
  Rig rig = stated;
  for (SceneLight& light : rig.scene.lights) light.led()->position_std_mm = std_mm;
  Instrument instrument(rig, scenes, {});
  const Measurement m = instrument.measure(capture::shots_from(
      rig.scene, capture::all_shots(rig.scene),
      capture::FrameSource([&](std::size_t i, std::size_t k) { return shots.frame(i, 3, k); })));
  for (const ChannelResult& r : m.results) {
    EXPECT_FALSE(r.refused()) << r.estimate.reasons.front();
    EXPECT_EQ(r.model, "dipole");
    const Medium& truth = stated.truth.materials.at("PE")[r.channel == 'R'   ? 0
                                                          : r.channel == 'G' ? 1
                                                                             : 2];
    const Quantity &s = r.estimate.sigma_s_prime_per_mm, &a = r.estimate.sigma_a_per_mm;
    EXPECT_LT(std::abs(s.value - truth.sigma_s_prime_per_mm), 3.0 * s.std) << r.channel;
    EXPECT_LT(std::abs(a.value - truth.sigma_a_per_mm), 3.0 * a.std) << r.channel;
  }
  return m;
}

// 4 of 100 mm change the light by several per cent, and by some tenths in the second order.
TEST(LedWatch, MeasuresByTheLightOfAnLedWhereTheShotsShowIt) {
  const Measurement m = measured_with_led_off(4.0, 3.0);
  ASSERT_FALSE(m.notes.empty());
  EXPECT_THAT(m.notes, ::testing::Contains(HasSubstr("taken to be where the shots show it")));
  // Judged by where the rig states it.
  const auto& pulls = m.results[1].estimate.pulls;
  const auto pull = std::find_if(pulls.begin(), pulls.end(), [](const PriorPull& p) {
    return p.name.ends_with("position0") && std::abs(p.offset) > 2.0;
  });
  ASSERT_NE(pull, pulls.end());
  EXPECT_NEAR(pull->offset, 4.0, 0.5);
}

TEST(LedWatch, LeavesAnLedThatIsNearWhereItIsStated) {
  const Measurement m = measured_with_led_off(0.1, 0.2);
  EXPECT_THAT(m.notes, ::testing::Not(::testing::Contains(HasSubstr("where the shots show it"))));
}

TEST(LedWatch, TellsOfDisplacedLedsOnly) {
  Scene scene;
  scene.lights.resize(2);
  scene.lights[0].name = "left";
  scene.lights[1].name = "right";
  for (SceneLight& light : scene.lights) {
    light.kind = LedLight();
    light.led()->position_std_mm = 1.0;
  }
  EXPECT_EQ(displaced_leds_note(scene), "");
  displace_leds({{"right", Eigen::Vector3d(0.0, -1.5, 0.25)}}, scene);
  const std::string note = displaced_leds_note(scene);
  EXPECT_THAT(note, HasSubstr("right is taken to be where the shots show it, [0.00, -1.50, 0.25]"));
  EXPECT_THAT(note, ::testing::Not(HasSubstr("left")));
}

}  // namespace
}  // namespace scattermeter::apps
