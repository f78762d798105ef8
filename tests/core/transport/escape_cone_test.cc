#include "core/transport/escape_cone.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/random_stream.h"
#include "core/material/fresnel.h"
#include "core/material/rough_boundary.h"
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

// Of a rough boundary, for the l of the axis: in either cone by its own transmittance.
TEST(EscapeCone, IsTheMeanOfARoughBoundary) {
  constexpr double kRoughEta = 1.4;
  const RoughBoundary boundary(0.3, kRoughEta);
  const EscapeCone cone(kRoughEta, 0.3);
  EXPECT_NEAR(std::cos(EscapeCone::kWideHalfAngle), EscapeCone::kCosWideHalf, 1e-12);
  constexpr double kAxis = 0.75;
  constexpr int kGrid = 200;
  const double sin_axis = std::sqrt(1.0 - kAxis * kAxis);
  double sr = 0.0, by_several_sr = 0.0;
  for (int i = 0; i < kGrid; ++i) {
    const double z = (i + 0.5) / kGrid;
    const double t = boundary.transmittance(z);
    const double by_several = boundary.transmittance_by_several(z);
    for (int j = 0; j < kGrid; ++j) {
      const double x = std::sqrt(1.0 - z * z) * std::cos(2.0 * std::numbers::pi * j / kGrid);
      const double along = x * sin_axis + z * kAxis;
      const double flux_sr = 2.0 * std::numbers::pi * z / (kGrid * kGrid);
      if (along > EscapeCone::kCosHalf) sr += t * flux_sr;
      if (along > EscapeCone::kCosWideHalf) by_several_sr += by_several * flux_sr;
    }
  }
  const double ft = fresnel_transmittance(kRoughEta, kAxis);
  EXPECT_NEAR(cone.transmitting_sr(kAxis), sr * ft / boundary.transmittance(kAxis), 0.01 * sr);
  EXPECT_NEAR(cone.transmitting_by_several_sr(kAxis) / ft,
              by_several_sr / boundary.transmittance_by_several(kAxis),
              0.01 * by_several_sr / boundary.transmittance_by_several(kAxis));
}

}  // namespace
}  // namespace scattermeter
