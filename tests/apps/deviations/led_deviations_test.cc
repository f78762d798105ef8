#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {
namespace {

struct Pair {
  Rig stated;
  TrueSetup truth;
  const Led& before(std::size_t shot = 0) const {
    return stated.scene.light(stated.scene.shots[shot].lights.front()).led()->led;
  }
  const Led& after(std::size_t shot = 0) const {
    return truth.shots[shot].lights.front().led()->led;
  }
};

Pair deviating_led(const char* kind, const DeviationDraw& draw) {
  const DeviationRun run{.kind = &deviation_named(kind), .body = "cube"};
  Pair out{stated_rig(run, 320), {}};
  out.truth = true_setup(out.stated, stated_mesh("cube"));
  if (run.kind->truth) run.kind->truth(out.truth, draw);
  if (run.kind->stated) run.kind->stated(out.stated, draw);
  return out;
}

TEST(LedDeviations, Places) {
  const Eigen::Vector3d object_mm(0, 0, 9);
  for (std::size_t shot : {0U, 1U}) {
    const Pair aside = deviating_led("LEDs displaced sideways", {2, -1, 1});
    const Eigen::Vector3d d = aside.after(shot).position_mm - aside.before(shot).position_mm;
    EXPECT_NEAR(d.norm(), 2.0, 1e-12);
    EXPECT_NEAR(d.dot(object_mm - aside.before(shot).position_mm), 0.0, 1e-10);
    const Pair nearer = deviating_led("LEDs displaced in depth", {2, 1, 1});
    EXPECT_NEAR((object_mm - nearer.after(shot).position_mm).norm(),
                (object_mm - nearer.before(shot).position_mm).norm() - 2.0, 1e-12);
  }
  const Pair turned = deviating_led("LED axes turned", {20, 1, 1});
  EXPECT_NEAR(turned.after().axis.norm(), 1.0, 1e-12);
  EXPECT_NEAR(turned.after().axis.z(), turned.before().axis.z(), 1e-12);
}

// Light that is added or shared out among emitters.
TEST(LedDeviations, Emitters) {
  const Pair split = deviating_led("LED of two emitters", {2, 1, 1});
  ASSERT_EQ(split.truth.shots[0].lights.size(), 2U);
  const Led& one = split.truth.shots[0].lights[0].led()->led;
  const Led& two = split.truth.shots[0].lights[1].led()->led;
  EXPECT_NEAR((0.5 * (one.position_mm + two.position_mm) - split.before().position_mm).norm(), 0,
              1e-12);
  EXPECT_NEAR((one.position_mm - two.position_mm).norm(), 4.0, 1e-12);
  EXPECT_TRUE((one.intensity_W_per_sr + two.intensity_W_per_sr)
                  .isApprox(split.before().intensity_W_per_sr));
  const Pair unlisted = deviating_led("unlisted LED", {20, 1, 1});
  EXPECT_TRUE(unlisted.truth.shots[1].lights[1].led()->led.intensity_W_per_sr.isApprox(
      0.2 * unlisted.before(1).intensity_W_per_sr));
}

TEST(LedDeviations, PowersAndFiles) {
  const Pair off = deviating_led("all LED intensities off", {20, -1, 1});
  EXPECT_TRUE(off.after(1).intensity_W_per_sr.isApprox(0.8 * off.before(1).intensity_W_per_sr));
  const Pair one = deviating_led("one LED's intensity off", {20, 1, 1});
  EXPECT_TRUE(one.after(0).intensity_W_per_sr.isApprox(1.2 * one.before(0).intensity_W_per_sr));
  EXPECT_TRUE(one.after(1).intensity_W_per_sr.isApprox(one.before(1).intensity_W_per_sr));
  const Pair colours = deviating_led("LED intensities of R and B exchanged", {1, 1, 1});
  EXPECT_EQ(colours.after().intensity_W_per_sr[0], colours.before().intensity_W_per_sr[2]);
  const Pair milli = deviating_led("LED intensity in another unit", {1000, 1, 1});
  EXPECT_TRUE(milli.before().intensity_W_per_sr.isApprox(1000 * milli.after().intensity_W_per_sr));
  const Pair metres = deviating_led("LED place in another unit of length", {1000, 1, 1});
  EXPECT_TRUE(metres.after().position_mm.isApprox(1000 * metres.before().position_mm));
  const Pair exchanged = deviating_led("LEDs exchanged", {1, 1, 1});
  EXPECT_EQ(exchanged.stated.scene.shots[0].lights.front(), "led2");
  EXPECT_EQ(exchanged.truth.shots[0].lights.front().name, "led1");
  const Pair file = deviating_led("first shot under the other LED", {1, 1, 1});
  EXPECT_EQ(file.truth.shots[0].lights.front().name, "led2");
  EXPECT_EQ(file.truth.shots[1].lights.front().name, "led2");
}

}  // namespace
}  // namespace scattermeter::apps
