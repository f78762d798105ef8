#include "calib/led/prior_led.h"

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

TEST(PriorLed, UncertaintyIsThatOfItsDeviations) {
  PriorLed prior;
  prior.led.axis = {0, 0, -1};
  prior.position_std_mm = 0.3;
  prior.axis_std_rad = 0.02;
  prior.exponent_std = 0.05;
  prior.power_relative_std = 0.01;
  const LedUncertainty u = uncertainty_of(prior);
  LedVector expected;
  expected << 0.09, 0.09, 0.09, 4e-4, 4e-4, 25e-4, 1e-4, 1e-4, 1e-4;
  EXPECT_LT((u.covariance - LedMatrix(expected.asDiagonal())).norm(), 1e-15);
  for (const Eigen::Vector3d& t : u.tangents) EXPECT_NEAR(t.dot(prior.led.axis), 0.0, 1e-15);
  EXPECT_TRUE(u.common.isZero());
}

TEST(PriorLed, AnEarlierCalibrationReplacesThem) {
  PriorLed prior;
  prior.position_std_mm = 0.3;
  prior.calibrated.emplace().covariance(0, 2) = 0.5;
  EXPECT_EQ(uncertainty_of(prior).covariance, prior.calibrated->covariance);
}

}  // namespace
}  // namespace scattermeter::calib
