#include "calib/radiance/white_scale.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

// Straight under a Lambertian LED: E = I / r^2, L = E / pi.
TEST(WhiteScale, RadianceUnderTheLed) {
  Led led;
  led.position_mm = {0, 0, 100};
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_NEAR(white_radiance_per_intensity(led, {0, 0, 0}, up), 1e-4 / std::numbers::pi, 1e-12);
  // 45 degrees away: twice the distance squared, both cosines sqrt(1/2).
  EXPECT_NEAR(white_radiance_per_intensity(led, {100, 0, 0}, up), 0.25e-4 / std::numbers::pi,
              1e-12);
  EXPECT_EQ(white_radiance_per_intensity(led, {0, 0, 0}, -up), 0.0);
}

TEST(WhiteScale, BracketIsWeightedByInverseVariance) {
  // 1 % and 3 %: weights 9 and 1.
  const WhiteScale scale = fit_white_scale({{100, 1, 1, 0}, {110, 10.89, 1, 0}, {0, 1, 1, 0}});
  ASSERT_TRUE(scale.ok);
  EXPECT_NEAR(std::log(scale.responsivity), std::log(100.0) + 0.1 * std::log(1.1), 1e-12);
  EXPECT_NEAR(scale.relative_std, 0.01 * std::sqrt(0.9), 1e-6);
  EXPECT_GT(scale.worst, 0.08);
  EXPECT_FALSE(fit_white_scale({}).ok);
  EXPECT_NEAR(fit_white_scale({{100, 0, 1, 0.02}}).relative_std, 0.02, 1e-12);
}

}  // namespace
}  // namespace scattermeter::calib
