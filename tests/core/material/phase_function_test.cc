#include "core/material/phase_function.h"

#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/phase_moments.h"

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

TEST(PhaseFunction, IsNormalisedWithTheMomentsThatItSays) {
  for (const Known& k : kKnown) {
    const Eigen::Vector3d moments = test_support::legendre_moments(k.phase);
    EXPECT_NEAR(moments[0], 1.0, 1e-6) << k.gamma;
    EXPECT_NEAR(moments[1], k.mean_cosine, 1e-6) << k.gamma;
    EXPECT_NEAR(moments[1], k.phase.mean_cosine(), 1e-6) << k.gamma;
    EXPECT_NEAR((1.0 - moments[2]) / (1.0 - moments[1]), k.gamma, 1e-5);
    EXPECT_NEAR(k.phase.gamma(), k.gamma, 1e-12);
  }
}

TEST(PhaseFunction, SamplesWhatItSays) {
  for (const Known& k : kKnown) {
    test_support::expect_samples(k.phase, k.mean_cosine, 1.0 - k.gamma * (1.0 - k.mean_cosine));
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
