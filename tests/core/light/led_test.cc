#include "core/light/led.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

// E = I cos^n(lobe) cos(surface) / r^2, by hand at 60 degrees on both sides.
TEST(Led, IrradianceByHand) {
  Led led;
  led.position_mm = {0, 0, 100};
  led.axis = {0, 0, -1};
  led.exponent = 2;
  // 60 degrees off the axis: r = 200 mm, cos 0.5 on both ends.
  const Eigen::Vector3d p(100 * std::sqrt(3.0), 0, 0);
  EXPECT_NEAR(led.transmitted_irradiance_per_mm2(p, Eigen::Vector3d::UnitZ(), 1.0),
              0.25 * 0.5 / 40'000.0, 1e-18);
  EXPECT_NEAR(led.transmitted_irradiance_per_mm2(p, Eigen::Vector3d::UnitZ(), 1.4),
              0.25 * 0.5 / 40'000.0 * fresnel_transmittance(1.4, 0.5), 1e-18);
}

TEST(Led, LobeIsDarkBehindAndUniformForExponentZero) {
  Led led;
  led.axis = {0, 0, -1};
  EXPECT_EQ(led.lobe({0, 0, 1}), 0.0);
  EXPECT_EQ(led.lobe({1, 0, 0}), 0.0);
  led.exponent = 0;
  EXPECT_EQ(led.lobe(Eigen::Vector3d(1, 0, -0.1).normalized()), 1.0);
  EXPECT_EQ(led.lobe({0, 0, 1}), 0.0);
}

TEST(Led, SurfaceFacingAwayIsDark) {
  Led led;
  led.position_mm = {0, 0, 100};
  EXPECT_EQ(led.transmitted_irradiance_per_mm2({0, 0, 0}, -Eigen::Vector3d::UnitZ(), 1.3), 0.0);
}

}  // namespace
}  // namespace scattermeter
