#include "apps/simulation/standard_body.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "core/material/dipole.h"
#include "core/material/fresnel.h"

namespace scattermeter::apps {
namespace {

std::array<Medium, 3> grey(double sigma_s_prime_per_mm, double sigma_a_per_mm) {
  std::array<Medium, 3> out;
  out.fill({sigma_s_prime_per_mm, sigma_a_per_mm, 1.4});
  return out;
}

// In the middle of a face that is many mean free paths wide, the dipole's total reflectance counts:
// the irradiance that enters, pi cos Ft(cos), times R_d, seen through Ft / pi.
TEST(StandardBody, AnOpaqueFaceIsThatOfAPlane) {
  const std::array<Medium, 3> media = {Medium{8.0, 0.02, 1.4}, Medium{8.0, 0.2, 1.4},
                                       Medium{8.0, 2.0, 1.4}};
  const Eigen::Array3d lit = standard_bodies({media})[0].at(StandardPlace::kLit);
  const double cos_in = Eigen::Vector3d(-0.3, -0.6, 0.7).normalized().z();
  const double cos_out = Eigen::Vector3d(0.7, -1.0, 0.8).normalized().z();
  for (std::size_t c = 0; c < 3; ++c) {
    // 2 pi ∫ R r dr by steps of equal ratio.
    const Dipole dipole(media[c]);
    double total = 0.0;
    const double step = 0.01;
    for (double log_r = -12.0; log_r < 5.0; log_r += step) {
      const double r = std::exp(log_r);
      total += 2.0 * std::numbers::pi * r * r * step * dipole.reflectance_per_mm2(r);
    }
    const double expected =
        cos_in * fresnel_transmittance(1.4, cos_in) * total * fresnel_transmittance(1.4, cos_out);
    EXPECT_NEAR(lit[static_cast<Eigen::Index>(c)], expected, 0.01 * expected) << c;
  }
}

// Light reaches the face in shadow through the material: the more, the less it scatters.
TEST(StandardBody, ShadowsAreLitThroughTheMaterial) {
  const std::vector<StandardBody> bodies = standard_bodies({grey(1.0, 0.002), grey(4.0, 0.002)});
  ASSERT_EQ(bodies.size(), 2U);
  EXPECT_LT(bodies[0].at(StandardPlace::kLit)[0], bodies[1].at(StandardPlace::kLit)[0]);
  EXPECT_GT(bodies[0].at(StandardPlace::kShadow)[0], 2.0 * bodies[1].at(StandardPlace::kShadow)[0]);
  EXPECT_GT(bodies[1].at(StandardPlace::kShadow)[0], 0.01);
  // The corners of the picture are background; nothing is brighter than white.
  const ColourRadiance& picture = bodies[0].picture;
  EXPECT_EQ(picture.rgb.front(), 0.0F);
  EXPECT_EQ(picture.rgb.back(), 0.0F);
  EXPECT_LT(*std::max_element(picture.rgb.begin(), picture.rgb.end()), 1.0F);
  EXPECT_LE(std::max(picture.width, picture.height), 96);
  EXPECT_GT(std::min(picture.width, picture.height), 80);
}

// A material looks the same whatever stands beside it, to the knots' interpolation.
TEST(StandardBody, IsThatOfTheMaterialAlone) {
  const StandardBody alone = standard_bodies({grey(1.5, 0.01)})[0];
  const StandardBody beside = standard_bodies({grey(6.0, 0.5), grey(1.5, 0.01)})[1];
  for (std::size_t i = 0; i < alone.picture.rgb.size(); ++i) {
    ASSERT_NEAR(alone.picture.rgb[i], beside.picture.rgb[i], 2e-3) << i;
  }
  EXPECT_TRUE(standard_bodies({}).empty());
}

}  // namespace
}  // namespace scattermeter::apps
