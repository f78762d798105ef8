#include "core/material/henyey_greenstein.h"

#include <gtest/gtest.h>

#include "tests/fixtures/core/phase_moments.h"

namespace scattermeter {
namespace {

TEST(HenyeyGreenstein, IsNormalisedWithMeanCosineG) {
  for (double g : {-0.6, 0.0, 0.3, 0.9}) {
    const Eigen::Vector3d moments = test_support::legendre_moments(HenyeyGreenstein(g));
    EXPECT_NEAR(moments[0], 1.0, 1e-6) << g;
    EXPECT_NEAR(moments[1], g, 1e-6) << g;
  }
}

TEST(HenyeyGreenstein, SamplesWhatItSays) {
  for (double g : {-0.6, 0.0, 0.3, 0.9}) {
    test_support::expect_samples(HenyeyGreenstein(g), g, g * g);
  }
}

}  // namespace
}  // namespace scattermeter
