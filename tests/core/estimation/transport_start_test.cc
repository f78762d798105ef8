#include "core/estimation/transport_start.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

Estimate estimate(double sigma_s_prime, double sigma_a, double relative_std = 0.1) {
  Estimate out;
  out.converged = true;
  out.sigma_s_prime_per_mm.value = sigma_s_prime;
  out.sigma_s_prime_per_mm.std = relative_std * sigma_s_prime;
  out.sigma_a_per_mm.value = sigma_a;
  return out;
}

ChannelResult searched(const std::string& material, const Estimate& dipole,
                       const Estimate& transport) {
  ChannelResult out;
  out.material = material;
  out.model = "transport";
  out.dipole = dipole;
  out.estimate = transport;
  return out;
}

void expect_at(const Estimate& start, double sigma_s_prime, double sigma_a) {
  EXPECT_NEAR(start.sigma_s_prime_per_mm.value, sigma_s_prime, 1e-12);
  EXPECT_NEAR(start.sigma_a_per_mm.value, sigma_a, 1e-12);
}

TEST(TransportStart, MovesAsTheMostSimilarMediumDid) {
  const std::vector<ChannelResult> found = {
      searched("wax", estimate(0.5, 0.01), estimate(1.0, 0.5)),
      searched("wax", estimate(1.0, 0.002), estimate(1.1, 0.005)),
      searched("milk", estimate(3.0, 0.002), estimate(2.0, 0.1)),
  };
  Estimate start = estimate(1.2, 0.001);
  start_like_others(found, "milk", start);
  expect_at(start, 1.32, 0.004);
}

// No search so far, one that failed or was refused, the dipole's alone, another kind of medium, one
// of which the dipole determined nothing.
TEST(TransportStart, StaysAtTheDipoleWithoutASimilarMedium) {
  std::vector<ChannelResult> found(1);
  found[0].model = "dipole";
  found[0].estimate = estimate(1.2, 0.001);
  found.push_back(searched("wax", estimate(1.2, 0.001), {}));
  found.push_back(searched("wax", estimate(1.2, 0.001), estimate(2.0, 0.1)));
  found.back().estimate.reasons = {"contradicted"};
  found.push_back(searched("wax", estimate(4.0, 0.001), estimate(5.0, 0.1)));
  found.push_back(searched("wax", estimate(1.2, 0.001, 3.0), estimate(5.0, 0.1)));
  Estimate start = estimate(1.2, 0.001);
  start_like_others(found, "wax", start);
  expect_at(start, 1.2, 0.001);
  // By difference, absorption may not become negative.
  found.push_back(searched("wax", estimate(1.2, 0.03), estimate(1.2, 0.01)));
  start = estimate(1.2, 0.015);
  start_like_others(found, "wax", start);
  expect_at(start, 1.2, 0.0);
}

TEST(TransportStart, IsThatOfTheMaterialWhereTheDipoleDeterminesNothing) {
  std::vector<ChannelResult> found = {
      searched("milk", estimate(1.2, 0.001), estimate(3.0, 0.02)),
      searched("wax", estimate(0.1, 0.001), estimate(1.1, 0.005)),
      searched("milk", estimate(1.2, 0.001), estimate(2.0, 0.01)),
  };
  Estimate start = estimate(0.001, 5.0, 20.0);
  start_like_others(found, "wax", start);
  expect_at(start, 1.1, 0.005);
  start = estimate(0.001, 5.0, 20.0);
  start_like_others(found, "soap", start);
  expect_at(start, 3.0, 0.02);
}

}  // namespace
}  // namespace scattermeter
