#include "core/transport/escape_cone.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/random_stream.h"
#include "core/material/fresnel.h"
#include "tests/fixtures/core/block_mean.h"

namespace scattermeter {
namespace {

TEST(EscapeCone, IsTheSineSquaredStraightAhead) {
  // Without a step of the index, 2 pi ∫ cos sin over the cone = pi sin^2; the cone's middle
  // weighs cos(axis) times that where all of it leaves.
  const double sin2 = std::pow(std::sin(EscapeCone::kHalfAngle), 2);
  const EscapeCone cone(1.0);
  EXPECT_NEAR(std::cos(EscapeCone::kHalfAngle), EscapeCone::kCosHalf, 1e-12);
  for (double cosine : {0.35, 0.5, 0.77, 1.0}) {
    EXPECT_NEAR(cone.transmitting_sr(cosine), std::numbers::pi * sin2 * cosine, 1e-4);
  }
}

// Directions drawn evenly over the sphere, slanted and grazing axes.
TEST(EscapeCone, IsTheMeanOverDirections) {
  RandomStream random(4, 0);
  for (double eta : {1.3, 1.8}) {
    const EscapeCone cone(eta);
    for (double cos_axis : {0.0, 0.11, 0.43, 0.9}) {
      const double sin_axis = std::sqrt(1.0 - cos_axis * cos_axis);
      test_support::BlockMean sr;
      for (int i = 0; i < 400'000; ++i) {
        const double z = random.uniform();
        const double x =
            std::sqrt(1.0 - z * z) * std::cos(2.0 * std::numbers::pi * random.uniform());
        const bool in = x * sin_axis + z * cos_axis > EscapeCone::kCosHalf;
        sr.add(in ? 2.0 * std::numbers::pi * z * fresnel_transmittance(eta, z) : 0.0);
      }
      const double c = cone.transmitting_sr(cos_axis);
      EXPECT_NEAR(c, sr.mean(), test_support::kSigmas * sr.std_error() + 1e-3 * c);
    }
  }
}

}  // namespace
}  // namespace scattermeter
