#include <gtest/gtest.h>

#include "tests/fixtures/core/cube_estimation.h"

namespace scattermeter {
namespace {

using test_support::CubeEstimation;
using test_support::DipoleCube;

// No image fits the dipole better than its own: auto leaves it at that.
TEST(TransportEstimator, AutoKeepsADipoleThatHolds) {
  DipoleCube cube(1, 3.0);
  cube.show(test_support::kCubeMedium, 2e-3, 7);
  CubeEstimation run(cube, "R");
  estimate_auto(run.estimation);
  const ChannelResult& result = run.estimation.results[0];
  EXPECT_EQ(result.model, "dipole");
  EXPECT_EQ(result.why_transport, "");
  EXPECT_FALSE(result.refused());
  EXPECT_FALSE(result.dipole.has_value());
  EXPECT_NEAR(result.estimate.sigma_s_prime_per_mm.value, 0.9, 0.05);
}

// A channel that the shot refuses stays refused; the other has the dipole's estimate beside that of
// transport, which no time is left for.
TEST(TransportEstimator, TransportStartsFromTheDipoleOfOpenChannels) {
  DipoleCube cube(1, 3.0);
  cube.show(test_support::kCubeMedium, 2e-3, 7);
  cube.shots[0].observation.channel[1].brightest_snr = 1.0;
  EstimateOptions options;
  options.time_limit_s = 0.0;
  CubeEstimation run(cube, "RG", options);
  estimate_transport(run.estimation);
  const ChannelResult& red = run.estimation.results[0];
  EXPECT_EQ(red.model, "transport");
  ASSERT_TRUE(red.dipole.has_value());
  EXPECT_TRUE(red.dipole->converged);
  EXPECT_NEAR(red.dipole->sigma_s_prime_per_mm.value, 0.9, 0.05);
  EXPECT_FALSE(red.estimate.converged);
  EXPECT_TRUE(red.refused());
  const ChannelResult& green = run.estimation.results[1];
  EXPECT_EQ(green.model, "transport");
  EXPECT_TRUE(green.refused());
  EXPECT_FALSE(green.dipole.has_value());
}

}  // namespace
}  // namespace scattermeter
