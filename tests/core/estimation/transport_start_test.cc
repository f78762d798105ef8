#include "core/estimation/transport_start.h"

#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

Estimate estimate(double sigma_s_prime, double sigma_a) {
  Estimate out;
  out.converged = true;
  out.sigma_s_prime_per_mm.value = sigma_s_prime;
  out.sigma_a_per_mm.value = sigma_a;
  return out;
}

ChannelResult searched(const Estimate& dipole, const Estimate& transport) {
  ChannelResult out;
  out.model = "transport";
  out.dipole = dipole;
  out.estimate = transport;
  return out;
}

TEST(TransportStart, MovesAsTheMostSimilarMediumDid) {
  const std::vector<ChannelResult> found = {
      searched(estimate(0.5, 0.01), estimate(1.0, 0.5)),
      searched(estimate(1.0, 0.002), estimate(1.1, 0.005)),
      searched(estimate(3.0, 0.002), estimate(2.0, 0.1)),
  };
  Estimate start = estimate(1.2, 0.001);
  start_like_others(found, start);
  EXPECT_NEAR(start.sigma_s_prime_per_mm.value, 1.32, 1e-12);
  EXPECT_NEAR(start.sigma_a_per_mm.value, 0.004, 1e-12);
}

// No search so far, one that failed, the dipole's alone, another kind of medium.
TEST(TransportStart, StaysAtTheDipoleWithoutASimilarMedium) {
  std::vector<ChannelResult> found(1);
  found[0].model = "dipole";
  found[0].estimate = estimate(1.2, 0.001);
  found.push_back(searched(estimate(1.2, 0.001), {}));
  found.push_back(searched(estimate(4.0, 0.001), estimate(5.0, 0.1)));
  Estimate start = estimate(1.2, 0.001);
  start_like_others(found, start);
  EXPECT_EQ(start.sigma_s_prime_per_mm.value, 1.2);
  EXPECT_EQ(start.sigma_a_per_mm.value, 0.001);
  // The same absorption by difference may not become negative.
  found.push_back(searched(estimate(1.2, 0.03), estimate(1.2, 0.01)));
  start = estimate(1.2, 0.015);
  start_like_others(found, start);
  EXPECT_EQ(start.sigma_a_per_mm.value, 0.0);
}

}  // namespace
}  // namespace scattermeter
