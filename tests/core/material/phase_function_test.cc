#include "core/material/phase_function.h"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/block_mean.h"

namespace scattermeter {
namespace {

struct Known {
  PhaseFunction phase;
  double mean_cosine, gamma;
};

const std::vector<Known> kKnown = {
    {0.0, 0.0, 1.0},
    {0.8, 0.8, 1.8},
    {PhaseFunction::mixture(0.75, 0.9, -0.4), 0.575, (1.0 - 0.6475) / 0.425},
    {PhaseFunction::with_gamma(0.8, 1.5), 0.8, 1.5},
    {PhaseFunction::with_gamma(0.3, 1.3), 0.3, 1.3},
};

// By the midpoint rule over the cosine.
TEST(PhaseFunction, IsNormalisedWithTheMomentsThatItSays) {
  for (const Known& k : kKnown) {
    double one = 0.0, first = 0.0, second = 0.0;
    constexpr int kSteps = 200'000;
    for (int i = 0; i < kSteps; ++i) {
      const double c = -1.0 + (i + 0.5) * 2.0 / kSteps;
      const double w = 2.0 * std::numbers::pi * k.phase.per_sr(c) * 2.0 / kSteps;
      one += w;
      first += w * c;
      second += w * (1.5 * c * c - 0.5);
    }
    EXPECT_NEAR(one, 1.0, 1e-6) << k.gamma;
    EXPECT_NEAR(first, k.mean_cosine, 1e-6) << k.gamma;
    EXPECT_NEAR(first, k.phase.mean_cosine(), 1e-6) << k.gamma;
    EXPECT_NEAR((1.0 - second) / (1.0 - first), k.gamma, 1e-5);
    EXPECT_NEAR(k.phase.gamma(), k.gamma, 1e-12);
  }
}

TEST(PhaseFunction, SamplesWhatItSays) {
  for (const Known& k : kKnown) {
    RandomStream random(4, 0);
    const Eigen::Vector3d before = Eigen::Vector3d(0.3, -0.5, -0.8).normalized();
    test_support::BlockMean p1, p2, across;
    for (int i = 0; i < 50'000; ++i) {
      const Eigen::Vector3d after = k.phase.sample(before, random);
      ASSERT_NEAR(after.norm(), 1.0, 1e-14);
      const double c = after.dot(before);
      p1.add(c);
      p2.add(1.5 * c * c - 0.5);
      across.add(after.dot(before.unitOrthogonal()));
    }
    const double second = 1.0 - k.gamma * (1.0 - k.mean_cosine);
    EXPECT_LT(std::abs(p1.z(k.mean_cosine)), test_support::kSigmas) << k.gamma;
    EXPECT_LT(std::abs(p2.z(second)), test_support::kSigmas) << k.gamma;
    EXPECT_LT(std::abs(across.z(0.0)), test_support::kSigmas) << k.gamma;
  }
}

TEST(PhaseFunction, RefusesWhatNoMixtureHas) {
  EXPECT_THROW(PhaseFunction::with_gamma(0.5, 1.6), std::invalid_argument);
  EXPECT_THROW(PhaseFunction::with_gamma(0.5, 0.5), std::invalid_argument);
  EXPECT_THROW(PhaseFunction::with_gamma(0.0, 1.0), std::invalid_argument);
  EXPECT_THROW(PhaseFunction(1.0).check(), std::invalid_argument);
  EXPECT_THROW(PhaseFunction::mixture(1.2, 0.3, 0.1).check(), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
