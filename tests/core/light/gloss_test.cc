#include "core/light/gloss.h"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/material/fresnel.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// In the mirror direction, D = 1 / (pi alpha^2), and with incidence at 45 degrees both ways:
//   L_o = D R / (4 cos^2 (1 + 2 Lambda)) E,  Lambda = (sqrt(1 + alpha^2) - 1) / 2.
TEST(Gloss, IsTheMicrofacetsPeakInTheMirrorDirection) {
  constexpr double kAlpha = 0.2;
  constexpr double kRoughEta = 1.4;
  const RayScene scene(test_support::make_box({-10, -10, -10}, {10, 10, 0}));
  Led led;
  led.position_mm = {-100, 0, 100};
  led.axis = -led.position_mm.normalized();
  const RoughBoundary boundary(kAlpha, kRoughEta);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  const double c = std::sqrt(0.5);
  const double irradiance = c / led.position_mm.squaredNorm();
  const double expected = 1.0 / (std::numbers::pi * kAlpha * kAlpha) *
                          (1.0 - fresnel_transmittance(kRoughEta, c)) /
                          (4.0 * c * c * std::sqrt(1.0 + kAlpha * kAlpha)) * irradiance;
  const double l = gloss_per_mm2(boundary, scene, led, {0, 0, 0}, up, {70, 0, 70});
  EXPECT_NEAR(l, std::numbers::pi * expected / fresnel_transmittance(kRoughEta, c), 1e-9 * l);
  // Dark below the horizon of either, and in shadow.
  EXPECT_EQ(gloss_per_mm2(boundary, scene, led, {0, 0, 0}, up, {70, 0, -1}), 0.0);
  led.position_mm = {-100, 0, -1};
  EXPECT_EQ(gloss_per_mm2(boundary, scene, led, {0, 0, 0}, up, {70, 0, 70}), 0.0);
}

}  // namespace
}  // namespace scattermeter
