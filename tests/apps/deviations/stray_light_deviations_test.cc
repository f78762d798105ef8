#include <cmath>

#include <gtest/gtest.h>

#include "apps/deviations/deviation_runs.h"

namespace scattermeter::apps {
namespace {

struct Added {
  TrueSetup truth;
  double led_W_per_mm2 = 0;  // irradiance by the first shot's LED at the object, R
  const SceneLight& light() const { return truth.shots[0].lights.at(1); }
  double on_W_per_mm2(const Eigen::Vector3d& normal) const {
    return light()->open_irradiance_W_per_mm2(normal)[0];
  }
};

Added added(const char* kind, const DeviationDraw& draw) {
  const DeviationRun run{.kind = &deviation_named(kind), .body = "cube"};
  Added out{true_setup(stated_rig(run, 320), stated_mesh("cube"))};
  run.kind->truth(out.truth, draw);
  const Led& led = out.truth.shots[0].lights[0].led()->led;
  const Eigen::Vector3d way_mm = Eigen::Vector3d(0, 0, 9) - led.position_mm;
  out.led_W_per_mm2 = led.transmitted_irradiance_per_mm2({0, 0, 9}, -way_mm.normalized(), 1.0) *
                      led.intensity_W_per_sr[0];
  return out;
}

TEST(StrayLightDeviations, EvenLight) {
  const Added even = added("even light", {5, 1, 1});
  for (const Eigen::Vector3d& n : {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0.6, -0.8, 0)}) {
    EXPECT_NEAR(even.on_W_per_mm2(n) / even.led_W_per_mm2, 0.05, 1e-3);
  }
}

// From half of all directions: all of it on a surface that faces them, half on one across.
TEST(StrayLightDeviations, LightFromOneSide) {
  const Added below = added("light from below", {1, 1, 1});
  EXPECT_NEAR(below.on_W_per_mm2({0, 0, -1}) / below.led_W_per_mm2, 0.01, 2e-4);
  EXPECT_NEAR(below.on_W_per_mm2({1, 0, 0}) / below.led_W_per_mm2, 0.005, 2e-4);
  EXPECT_NEAR(below.on_W_per_mm2({0, 0, 1}) / below.led_W_per_mm2, 0.0, 2e-4);
  for (const double sign : {1.0, -1.0}) {
    const Added side = added("light from a side", {1, sign, 1});
    EXPECT_NEAR(side.on_W_per_mm2({sign, 0, 0}) / side.led_W_per_mm2, 0.01, 2e-4);
    EXPECT_NEAR(side.on_W_per_mm2({-sign, 0, 0}) / side.led_W_per_mm2, 0.0, 2e-4);
  }
}

TEST(StrayLightDeviations, Counts) {
  std::vector<ColourFrame> frames(1, black_frame(101, 80, 4000.0));
  frames[0].object = {20, 20, 40, 40};
  for (auto& plane : frames[0].counts) plane[frames[0].index(40, 40)] = 1000.0F;
  const std::vector<ColourFrame> point = frames;
  deviation_named("halo of the lens").frames(frames, {5, 1, 1});
  EXPECT_NEAR(mean_counts(frames[0], 1), 1.05 * mean_counts(point[0], 1), 1e-4);
  EXPECT_GT(frames[0].at(1, 45, 40), 0.0F);
  frames = point;
  deviation_named("black level tilted").frames(frames, {30, 1, 1});
  EXPECT_NEAR(frames[0].at(0, 0, 0), 0.0, 1e-3);
  EXPECT_NEAR(frames[0].at(0, 50, 7), 30.0 * 50.0 / 101.0, 1e-3);
  frames = point;
  deviation_named("backdrop not black").frames(frames, {20, 1, 1});
  EXPECT_NEAR(frames[0].at(2, 3, 3), 800.0, 1e-3);
  EXPECT_EQ(frames[0].at(2, 40, 40), 1000.0F);
}

TEST(StrayLightDeviations, BlackLevels) {
  const DeviationRun run{.kind = &deviation_named("black level off at one site"), .body = "cube"};
  TrueSetup truth = true_setup(stated_rig(run, 320), stated_mesh("cube"));
  run.kind->truth(truth, {30, -1, 6});
  EXPECT_EQ(truth.rig.scene.camera.sensor.black_counts, (std::array<int, 4>{64, 64, 34, 64}));
}

}  // namespace
}  // namespace scattermeter::apps
