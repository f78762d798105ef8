#include "core/material/fresnel.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Normal incidence: T = 4 n / (n + 1)^2.
TEST(Fresnel, NormalIncidenceIsTheClosedForm) {
  for (double n : {1.0, 1.3, 1.5, 2.4, 1 / 1.3}) {
    EXPECT_NEAR(fresnel_transmittance(n, 1.0), 4.0 * n / ((n + 1) * (n + 1)), 1e-15);
  }
}

// At Brewster's angle (tan = n) p-light is not reflected; s-light by ((n^2 - 1) / (n^2 + 1))^2.
TEST(Fresnel, BrewsterAngle) {
  const double n = 1.5;
  const double rs = (n * n - 1) / (n * n + 1);
  EXPECT_NEAR(fresnel_transmittance(n, 1.0 / std::sqrt(1 + n * n)), 1.0 - 0.5 * rs * rs, 1e-14);
}

TEST(Fresnel, TotalReflectionAndGrazing) {
  EXPECT_EQ(fresnel_transmittance(1 / 1.5, std::cos(std::asin(1 / 1.5) + 1e-6)), 0.0);
  EXPECT_GT(fresnel_transmittance(1 / 1.5, std::cos(std::asin(1 / 1.5) - 1e-6)), 0.0);
  EXPECT_EQ(fresnel_transmittance(1.5, 0.0), 0.0);
  EXPECT_EQ(fresnel_transmittance(1.5, -0.5), 0.0);
  EXPECT_THROW(fresnel_transmittance(0.0, 1.0), std::invalid_argument);
}

// Reciprocity: going in at theta_i and coming out along the refracted ray pass the same share. This
// catches an exchanged eta.
TEST(Fresnel, IsReciprocal) {
  for (double c : {0.1, 0.5, 0.9}) {
    const double n = 1.33;
    const double cos_inside = std::sqrt(1.0 - (1.0 - c * c) / (n * n));
    EXPECT_NEAR(fresnel_transmittance(n, c), fresnel_transmittance(1 / n, cos_inside), 1e-14);
  }
}

// F_dr = ∫ (1 - T) 2 cos dcos over the inner hemisphere.
TEST(Fresnel, DiffuseReflectanceFitMeetsQuadrature) {
  for (double n : {1.1, 1.2, 1.3, 1.4, 1.5, 1.6}) {
    const int steps = 20'000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double c = (i + 0.5) / steps;
      sum += (1.0 - fresnel_transmittance(1 / n, c)) * 2.0 * c / steps;
    }
    EXPECT_NEAR(diffuse_internal_reflectance(n), sum, 0.005) << "eta " << n;
  }
}

TEST(Fresnel, MismatchIsOneWithoutBoundary) { EXPECT_NEAR(boundary_mismatch(1.0), 1.0, 0.005); }

}  // namespace
}  // namespace scattermeter
