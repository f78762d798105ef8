#include "core/estimation/channel_result.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

Estimate converged(double sigma_s_prime_per_mm, double sigma_a_per_mm) {
  Estimate estimate;
  estimate.converged = true;
  estimate.sigma_s_prime_per_mm.value = sigma_s_prime_per_mm;
  estimate.sigma_a_per_mm.value = sigma_a_per_mm;
  return estimate;
}

TEST(ChannelResult, DipoleDistanceIsRelativeForScatteringAndAbsoluteForAbsorption) {
  ChannelResult result;
  result.estimate = converged(2.0, 0.010);
  result.dipole = converged(1.9, 0.004);
  const auto distance = dipole_distance(result);
  ASSERT_TRUE(distance.has_value());
  EXPECT_NEAR(distance->sigma_s_prime_relative, -0.05, 1e-15);
  EXPECT_NEAR(distance->sigma_a_per_mm, -0.006, 1e-15);
}

TEST(ChannelResult, DipoleDistanceNeedsTwoEstimates) {
  ChannelResult result;
  result.estimate = converged(2.0, 0.010);
  EXPECT_FALSE(dipole_distance(result).has_value());
  result.dipole = converged(1.9, 0.004);
  result.dipole->converged = false;
  EXPECT_FALSE(dipole_distance(result).has_value());
  result.dipole->converged = true;
  result.estimate.converged = false;
  EXPECT_FALSE(dipole_distance(result).has_value());
}

// From a dipole that determines nothing, nothing is far or near.
TEST(ChannelResult, DipoleDistanceNeedsADeterminedDipole) {
  ChannelResult result;
  result.estimate = converged(2.0, 0.010);
  for (const double std : {1.0, std::nan("")}) {
    result.dipole = converged(1.9, 0.004);
    result.dipole->sigma_s_prime_per_mm.std = std;
    EXPECT_FALSE(dipole_distance(result).has_value()) << std;
  }
}

// An eta that changes the image by 3 % while the medium changed by 1 %; the scale is no change that
// depends on the medium.
TEST(ChannelResult, ChangesOfTheImageAreBentByThatOfTheMedium) {
  Estimate at = converged(1.0, 0.0);
  ChannelResult result;
  result.image_in_std = 1e4;
  result.estimate = converged(std::exp(0.01), 0.0);
  EXPECT_EQ(bent_in_std(at, result), 0.0);
  PriorPull eta{"eta", "eta"}, scale{"scale", "scale"};
  eta.image_relative = 0.03;
  scale.image_relative = 0.5;
  result.estimate.pulls = {eta, scale};
  EXPECT_NEAR(bent_in_std(at, result), 3.0, 1e-9);
  EXPECT_EQ(bent_in_std(result.estimate, result), 0.0);
  EXPECT_EQ(bent_in_std(Estimate(), result), 0.0);
  result.estimate.misfit_p_value = 1e-9;
  result.estimate.misfit_relative = 0.01;
  EXPECT_EQ(bent_in_std(at, result), 0.0);
  at.misfit_relative = 0.05;
  EXPECT_NEAR(bent_in_std(at, result), 3.0, 1e-9);
}

TEST(ChannelResult, IsRefusedByAnyReason) {
  ChannelResult result;
  EXPECT_FALSE(result.refused());
  result.estimate.reasons = {"the fit did not converge"};
  EXPECT_TRUE(result.refused());
}

}  // namespace
}  // namespace scattermeter
