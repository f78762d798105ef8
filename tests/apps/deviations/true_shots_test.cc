#include "apps/deviations/true_shots.h"

#include <cmath>

#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"
#include "apps/simulation/virtual_shots.h"

namespace scattermeter::apps {
namespace {

struct SmallShots {
  Rig stated;
  TrueSetup truth;
};
SmallShots small_setup() {
  const DeviationRun run{.kind = &deviation_named("none"), .body = "cube", .seed = 4};
  SmallShots out{stated_rig(run, 240), {}};
  out.truth = true_setup(out.stated, stated_mesh("cube"));
  return out;
}

// Without a deviation the shots are those that `simulate` makes of the same rig.
TEST(TrueShots, AreThoseOfSimulate) {
  const SmallShots setup = small_setup();
  UnitPictures pictures(10'000);
  const ExpectedShots shots = expected_shots(setup.truth, setup.stated, false, pictures);
  EXPECT_EQ(shots.rendering_counts2_per_count, 0.0);
  Rig exposed = setup.stated;
  exposed.scene.camera.exposure_s = shots.exposure_s;
  const ObjectScenes objects =
      open_objects(exposed, [](const SceneObject&) { return stated_mesh("cube"); });
  const VirtualShots simulated(exposed, objects, {.noise = false});
  for (std::size_t i = 0; i < 2; ++i) {
    const std::vector<float> raw = mosaic(shots.frames[i], exposed.scene.camera.sensor.cfa);
    const std::vector<float> expected = simulated.whole_signal_counts(i);
    ASSERT_EQ(raw.size(), expected.size());
    for (std::size_t k = 0; k < raw.size(); ++k) {
      ASSERT_NEAR(raw[k], expected[k], 1e-4 * expected[k] + 1e-3) << k;
    }
  }
}

TEST(TrueShots, Exposure) {
  SmallShots setup = small_setup();
  UnitPictures pictures(10'000);
  const auto brightest = [&] {
    const ExpectedShots shots = expected_shots(setup.truth, setup.stated, false, pictures);
    return std::max(counts_exceeded(shots.frames[0], 1e-3), counts_exceeded(shots.frames[1], 1e-3));
  };
  // Three quarters of the range, rounded down to two digits, whatever the light.
  EXPECT_LE(brightest(), 0.75 * 4031);
  EXPECT_GT(brightest(), 0.67 * 4031);
  for (TrueShot& shot : setup.truth.shots) {
    shot.lights[0].led()->led.intensity_W_per_sr *= 7.0;
  }
  EXPECT_LE(brightest(), 0.75 * 4031);
  EXPECT_GT(brightest(), 0.67 * 4031);
  for (TrueShot& shot : setup.truth.shots) shot.lights.clear();
  EXPECT_EQ(brightest(), 0.0);
}

TEST(TrueShots, FilesSayWhatIsStated) {
  SmallShots setup = small_setup();
  UnitPictures pictures(10'000);
  const ExpectedShots shots = expected_shots(setup.truth, setup.stated, false, pictures);
  const capture::RawFrame plain = exposed_frames(shots, setup.truth, setup.stated, 1)[1];
  setup.truth.rig.scene.camera.sensor.black_counts = {100, 100, 100, 100};
  setup.truth.rig.scene.camera.sensor.white_counts = 1000;
  const capture::RawFrame frame = exposed_frames(shots, setup.truth, setup.stated, 1)[1];
  EXPECT_EQ(frame.black_counts, plain.black_counts);
  EXPECT_EQ(frame.white_counts, 4095);
  EXPECT_EQ(frame.exposure_s, shots.exposure_s);
  EXPECT_NEAR(frame.at(1, 1) - plain.at(1, 1), 36.0, 1.01);  // the same noise
  EXPECT_EQ(*std::max_element(frame.samples.begin(), frame.samples.end()), 1000);
  EXPECT_GT(*std::max_element(plain.samples.begin(), plain.samples.end()), 2000);
  EXPECT_NE(exposed_frames(shots, setup.truth, setup.stated, 2)[1].samples, plain.samples);
}

TEST(TrueShots, TwoMaterials) {
  SmallShots setup = small_setup();
  UnitPictures pictures(10'000);
  const ExpectedShots one = expected_shots(setup.truth, setup.stated, false, pictures);
  for (TrueShot& shot : setup.truth.shots) {
    std::array<Medium, 3> darker = shot.media;
    for (Medium& m : darker) m.sigma_a_per_mm *= 10.0;
    shot.right_half = darker;
  }
  const ExpectedShots two = expected_shots(setup.truth, setup.stated, false, pictures);
  const PixelRect& r = two.frames[0].object;
  const int y = r.y0 + r.height / 2;
  for (const auto& [x, same] :
       {std::pair{r.x0 + r.width / 4, true}, std::pair{r.x0 + 3 * r.width / 4, false}}) {
    const double ratio =
        two.frames[0].at(1, x, y) / two.exposure_s / (one.frames[0].at(1, x, y) / one.exposure_s);
    if (same) {
      EXPECT_NEAR(ratio, 1.0, 1e-5);
    } else {
      EXPECT_LT(ratio, 0.8);
    }
  }
}

}  // namespace
}  // namespace scattermeter::apps
