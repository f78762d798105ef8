#include "core/estimation/channel_weights.h"

#include <atomic>
#include <string>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

// Shots of one view share their weights, and what is there already is not made again.
TEST(ChannelWeights, EachViewAndLightIsMadeOnce) {
  test_support::DipoleCube cube(2);
  cube.scene.shots[1].lights = {"led", "led2"};
  std::atomic<int> made = 0;
  const auto make = [&](const SeenObject& seen, const SourceCloud& sources) {
    ++made;
    return WeightMatrix::Constant(static_cast<Eigen::Index>(seen.sites.size()), 1,
                                  static_cast<double>(sources.size()))
        .eval();
  };
  Weights weights;
  const std::span<const ObservedShot> shots = cube.shots;
  add_weights(cube.scene, shots.first(1), cube.lit, nullptr, make, weights);
  EXPECT_EQ(made, 1);
  add_weights(cube.scene, shots, cube.lit, nullptr, make, weights);
  EXPECT_EQ(made, 2);
  ASSERT_EQ(weights.size(), 2U);
  for (const std::string name : {"led", "led2"}) {
    const WeightMatrix& w = weights.at({cube.shots[0].seen.get(), name, 0});
    ASSERT_EQ(w.rows(), static_cast<Eigen::Index>(cube.shots[0].seen->sites.size()));
    // Of that light's own sources.
    EXPECT_EQ(w(0, 0), static_cast<double>(cube.lit.light("cube", name, 0).lit.size()));
  }
}

// Where a light reaches nothing, nothing half-made is left for the shots that follow.
TEST(ChannelWeights, AFailureLeavesThemAsTheyWere) {
  test_support::DipoleCube cube(2);
  cube.scene.shots[1].lights = {"led", "led2"};
  cube.scene.lights[1].led()->led.position_mm = {0.0, 0.0, -50.0};
  cube.scene.lights[1].led()->led.axis = -Eigen::Vector3d::UnitZ();
  Weights weights;
  EXPECT_THROW(add_smooth_weights(cube.scene, cube.shots, cube.lit, nullptr, weights), InputError);
  EXPECT_TRUE(weights.empty());
  EXPECT_TRUE(cube.lit.reaches("cube", "led", 0));
  EXPECT_FALSE(cube.lit.reaches("cube", "led2", 0));
}

// The knots' shares of every pair add up to 1: a row sums to all the power that enters the object.
TEST(ChannelWeights, RowsSumToThePowerThatEnters) {
  test_support::DipoleCube cube;
  Weights weights;
  add_smooth_weights(cube.scene, cube.shots, cube.lit, nullptr, weights);
  const WeightMatrix& w = weights.at({cube.shots[0].seen.get(), "led", 0});
  double power_sr = 0.0;
  for (const LitTriangle& t : cube.lit.light("cube", "led", 0).lit) {
    const auto& e = t.irradiance_sr_per_mm2;
    power_sr += (e[0] + e[1] + e[2]) / 3.0 * area_mm2(t.corners_mm);
  }
  ASSERT_GT(power_sr, 0.0);
  for (Eigen::Index j = 0; j < w.rows(); ++j)
    EXPECT_NEAR(w.row(j).sum(), power_sr, 1e-4 * power_sr);
}

TEST(ChannelWeights, KnotsReachFromASixteenthOfAPatchAcrossTheObject) {
  const test_support::DipoleCube cube(1, 4.0);
  const DistanceKnots knots = smooth_knots(cube.lit);
  EXPECT_DOUBLE_EQ(knots.resolution_mm(), 0.25);
  EXPECT_GE(knots.max_distance_mm(), 20.0 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(pair_options(knots).floor_mm, 0.25);
}

}  // namespace
}  // namespace scattermeter
