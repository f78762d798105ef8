#include "core/light/led_light.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/total_power.h"

namespace scattermeter {
namespace {

LedLight led_above() {
  LedLight light;
  light.led.position_mm = {10, -20, 60};
  light.led.axis = Eigen::Vector3d(-10, 20, -50).normalized();
  light.led.intensity_W_per_sr = {0.1, 0.2, 0.3};
  return light;
}

TEST(LedLight, AnExactLedHasNoNuisances) {
  const LedLight light = led_above();
  EXPECT_TRUE(light.changes({0, 0, 10}).empty());
  EXPECT_TRUE(light.nuisances("led", 1).empty());
  EXPECT_EQ(light.channels(), 1U);
  EXPECT_EQ(light.power()[2], 0.3);
}

TEST(LedLight, StatedDeviationsAreNuisancesOfTheirOwn) {
  LedLight light = led_above();
  light.position_std_mm = 0.2;
  light.exponent_std = 0.05;
  light.intensity_relative_std = 0.01;
  const auto changes = light.changes({0, 0, 10});
  ASSERT_EQ(changes.size(), 4U);
  const auto nuisances = light.nuisances("led", 0);
  ASSERT_EQ(nuisances.size(), 5U);
  for (Eigen::Index k = 0; k < 4; ++k) {
    const LightNuisance& v = nuisances[static_cast<std::size_t>(k)];
    EXPECT_EQ(v.of_change, Eigen::VectorXd::Unit(4, k)) << v.name;
    EXPECT_EQ(v.std, k < 3 ? 0.2 : 0.05);
  }
  EXPECT_EQ(nuisances[0].name, "led.position0");
  EXPECT_EQ(nuisances[4].of_power, 1.0);
  EXPECT_EQ(nuisances[4].of_change.size(), 0);
}

TEST(LedLight, StandsWhereItIsDisplacedTo) {
  LedLight light = led_above();
  light.position_std_mm = 0.2;
  light.axis_std_rad = 0.02;
  light.exponent_std = 0.05;
  EXPECT_EQ(light.displacement().size(), 0);
  const Led stated = light.led;
  Eigen::VectorXd by(6);
  by << 1.0, -2.0, 0.5, 0.15, -0.1, 0.2;
  light.displace(2.0 * by);
  light.displace(by);  // from the stated one again
  EXPECT_LT((light.led.position_mm - stated.position_mm - by.head<3>()).norm(), 1e-12);
  EXPECT_NEAR(light.led.exponent, stated.exponent + 0.2, 1e-12);
  EXPECT_NEAR(std::acos(light.led.axis.dot(stated.axis)), std::atan(std::hypot(0.15, 0.1)), 1e-9);
  EXPECT_LT((light.displacement() - by).norm(), 1e-12);
  // Its changes go on from there, along the same quantities.
  const auto changes = light.changes({0, 0, 10});
  ASSERT_EQ(changes.size(), 6U);
  for (Eigen::Index k = 0; k < 6; ++k) {
    const LightChange& change = changes[static_cast<std::size_t>(k)];
    const Eigen::VectorXd expected = by + change.step * Eigen::VectorXd::Unit(6, k);
    EXPECT_LT((change.changed->displacement() - expected).norm(), 1e-12) << k;
  }
}

// A change over its step is the derivative of the light that enters, to the order of the step.
TEST(LedLight, ChangesAreDerivatives) {
  LedLight light = led_above();
  light.position_std_mm = 0.1;
  const TriangleMesh cube = test_support::make_cube();
  const RayScene scene(cube);
  const PatchMesh patches(cube, 2.0);
  const auto power = [&](const Light& l) {
    return test_support::total(l.illuminate(patches, scene, 1.3, LightUse::kMeasure)[0]);
  };
  const auto changes = light.changes({0, 0, 10});
  for (int axis = 0; axis < 3; ++axis) {
    const LightChange& change = changes[static_cast<std::size_t>(axis)];
    const double forward = (power(*change.changed) - power(light)) / change.step;
    LedLight up = light, down = light;
    up.led.position_mm[axis] += 0.01;
    down.led.position_mm[axis] -= 0.01;
    const double central = (power(up) - power(down)) / 0.02;
    EXPECT_NEAR(forward, central, 0.05 * power(light) / 60.0) << axis;
  }
}

// The calibrated nuisances of a channel, put together again, are the covariance of the parameters
// that the channel sees.
TEST(LedLight, CalibratedNuisancesHoldTheCovariance) {
  LedLight light = led_above();
  Eigen::Matrix<double, kLedParameters, 12> root;
  for (Eigen::Index i = 0; i < root.rows(); ++i) {
    for (Eigen::Index k = 0; k < root.cols(); ++k) {
      root(i, k) = std::sin(1.0 + 3.0 * static_cast<double>(i) + 7.0 * static_cast<double>(k * k));
    }
  }
  LedUncertainty u;
  u.tangents[0] = light.led.axis.unitOrthogonal();
  u.tangents[1] = light.led.axis.cross(u.tangents[0]);
  u.common = 0.3 * root.col(0);
  u.covariance = root * root.transpose() + u.common * u.common.transpose();
  light.calibrated = u;
  ASSERT_EQ(light.changes({0, 0, 10}).size(), 6U);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Eigen::Matrix<double, 7, 7> sum = Eigen::Matrix<double, 7, 7>::Zero();
    for (const LightNuisance& v : light.nuisances("led", channel)) {
      Eigen::Matrix<double, 7, 1> column;
      column << v.of_change, v.of_power;
      sum += v.std * v.std * column * column.transpose();
    }
    std::vector<Eigen::Index> seen = {0, 1, 2, 3, 4, 5, 6 + static_cast<Eigen::Index>(channel)};
    const Eigen::MatrixXd expected = u.covariance(seen, seen);
    EXPECT_LT((sum - expected).norm(), 1e-9 * expected.norm()) << channel;
  }
}

}  // namespace
}  // namespace scattermeter
