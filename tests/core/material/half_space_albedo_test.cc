#include "core/material/half_space_albedo.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// Normal incidence on albedo 0.9 and 0.99 (values to six figures of Chandrasekhar's H(1)).
TEST(HalfSpaceAlbedo, MeetsChandrasekhar) {
  EXPECT_NEAR(half_space_albedo(0.9, 1.0), 0.414947, 1e-6);
  EXPECT_NEAR(half_space_albedo(0.99, 1.0), 0.752721, 1e-6);
}

// The zeroth moment of H is 2 (1 - sqrt(1 - albedo)) / albedo exactly (Chandrasekhar, chapter V,
// theorem 1): it says what isotropic light over the hemisphere (not weighed by the cosine) loses.
TEST(HalfSpaceAlbedo, HKeepsItsMoment) {
  for (double albedo : {0.1, 0.5, 0.9, 0.999}) {
    const double root = std::sqrt(1.0 - albedo);
    double moment = 0.0;
    constexpr int kSteps = 500;
    for (int i = 0; i < kSteps; ++i) {
      // mu = u^2, as H is steep at 0.
      const double u = (i + 0.5) / kSteps;
      moment += 2.0 * u / kSteps * (1.0 - half_space_albedo(albedo, u * u)) / root;
    }
    EXPECT_NEAR(moment, 2.0 * (1.0 - root) / albedo, 1e-5) << albedo;
  }
}

// Diffuse light is the mean over directions, weighed by the cosine.
TEST(HalfSpaceAlbedo, DiffuseIsTheMeanOfDirections) {
  for (double albedo : {0.3, 0.95}) {
    double sum = 0.0;
    constexpr int kSteps = 400;
    for (int i = 0; i < kSteps; ++i) {
      const double mu = (i + 0.5) / kSteps;
      sum += 2.0 * mu / kSteps * half_space_albedo(albedo, mu);
    }
    EXPECT_NEAR(half_space_albedo(albedo), sum, 1e-5) << albedo;
  }
}

TEST(HalfSpaceAlbedo, Ends) {
  EXPECT_EQ(half_space_albedo(0.0), 0.0);
  EXPECT_NEAR(half_space_albedo(1.0), 1.0, 1e-12);
  // Little absorption: 1 - A = 4 / sqrt(3) sqrt(1 - albedo), as the first moment of H tends to
  // 2 / sqrt(3).
  EXPECT_NEAR((1.0 - half_space_albedo(1.0 - 1e-10)) / 1e-5, 4.0 / std::sqrt(3.0), 1e-4);
  EXPECT_THROW(half_space_albedo(-0.1), std::invalid_argument);
  EXPECT_THROW(half_space_albedo(1.1), std::invalid_argument);
  EXPECT_THROW(half_space_albedo(0.5, 0.0), std::invalid_argument);
  EXPECT_THROW(half_space_albedo(std::numeric_limits<double>::quiet_NaN()), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
