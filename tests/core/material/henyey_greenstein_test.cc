#include "core/material/henyey_greenstein.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/fixtures/core/block_mean.h"

namespace scattermeter {
namespace {

// Normalised, mean cosine g: midpoint rule over the cosine.
TEST(HenyeyGreenstein, IsNormalisedWithMeanCosineG) {
  for (double g : {-0.6, 0.0, 0.3, 0.9}) {
    const HenyeyGreenstein phase(g);
    double one = 0.0, mean = 0.0;
    constexpr int kSteps = 200'000;
    for (int i = 0; i < kSteps; ++i) {
      const double c = -1.0 + (i + 0.5) * 2.0 / kSteps;
      const double w = 2.0 * std::numbers::pi * phase.per_sr(c) * 2.0 / kSteps;
      one += w;
      mean += w * c;
    }
    EXPECT_NEAR(one, 1.0, 1e-6) << g;
    EXPECT_NEAR(mean, g, 1e-6) << g;
  }
}

// Legendre moments of the samples are g and g^2; the direction keeps its length, and the angle
// about the old direction is even.
TEST(HenyeyGreenstein, SamplesWhatItSays) {
  for (double g : {-0.6, 0.0, 0.3, 0.9}) {
    const HenyeyGreenstein phase(g);
    RandomStream random(4, 0);
    const Eigen::Vector3d before = Eigen::Vector3d(0.3, -0.5, -0.8).normalized();
    test_support::BlockMean p1, p2, across;
    for (int i = 0; i < 50'000; ++i) {
      const Eigen::Vector3d after = phase.sample(before, random);
      ASSERT_NEAR(after.norm(), 1.0, 1e-14);
      const double c = after.dot(before);
      p1.add(c);
      p2.add(1.5 * c * c - 0.5);
      across.add(after.dot(before.unitOrthogonal()));
    }
    EXPECT_LT(std::abs(p1.z(g)), test_support::kSigmas) << g;
    EXPECT_LT(std::abs(p2.z(g * g)), test_support::kSigmas) << g;
    EXPECT_LT(std::abs(across.z(0.0)), test_support::kSigmas) << g;
  }
}

}  // namespace
}  // namespace scattermeter
