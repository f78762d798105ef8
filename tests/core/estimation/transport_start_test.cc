#include "core/estimation/transport_start.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/atlas/transport_atlas.h"

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

TEST(TransportStart, KeepsTheDipolesEstimate) {
  ChannelResult by_dipole;
  by_dipole.material = "PP";
  by_dipole.model = "dipole";
  by_dipole.estimate = estimate(1.0, 0.01);
  by_dipole.rows.resize(2);
  const ChannelResult start = start_from_dipole(by_dipole);
  EXPECT_EQ(start.material, "PP");
  EXPECT_EQ(start.model, "transport");
  EXPECT_TRUE(start.rows.empty());
  ASSERT_TRUE(start.dipole);
  EXPECT_EQ(start.dipole->sigma_s_prime_per_mm.value, 1.0);
  EXPECT_EQ(start.estimate.sigma_a_per_mm.value, 0.01);
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
  start_like_others(found, start);
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
  start_like_others(found, start);
  expect_at(start, 1.2, 0.001);
  // By difference, absorption may not become negative.
  found.push_back(searched("wax", estimate(1.2, 0.03), estimate(1.2, 0.01)));
  start = estimate(1.2, 0.015);
  start_like_others(found, start);
  expect_at(start, 1.2, 0.0);
}

TEST(TransportStart, StaysWhereTheDipoleDeterminesNothing) {
  const std::vector<ChannelResult> found = {
      searched("milk", estimate(0.001, 5.0), estimate(3.0, 0.02))};
  Estimate start = estimate(0.001, 5.0, 20.0);
  start_like_others(found, start);
  expect_at(start, 0.001, 5.0);
}

TEST(TransportStart, IsWhereTransportEndedBefore) {
  ChannelResult before = searched("milk", estimate(0.001, 5.0, 20.0), estimate(3.0, 0.02));
  before.channel = 'G';
  ChannelResult result = before;
  result.estimate = *before.dipole;
  EXPECT_TRUE(start_as_before(std::vector{before}, result));
  expect_at(result.estimate, 3.0, 0.02);
  // Another channel, the dipole's alone, and a search that found nothing.
  result.estimate = *before.dipole;
  std::vector<ChannelResult> others(3, before);
  others[0].channel = 'R';
  EXPECT_FALSE(start_as_before(std::span(others).first(1), result));
  others[1].model = "dipole";
  EXPECT_FALSE(start_as_before(std::span(others).subspan(1, 1), result));
  others[2].estimate.converged = false;
  EXPECT_FALSE(start_as_before(std::span(others).last(1), result));
  expect_at(result.estimate, 0.001, 5.0);
}

// Light that, in a body of 20 mm, falls with the distance: near light tells sigma_s, far light
// sigma_a. Noise is 10 %, and shots end where a fiftieth of the light is left by absorption.
class NearestPoint : public ::testing::TestWithParam<double> {
 protected:
  static double per_reach_mm(double sigma_s, double sigma_a) {
    return std::sqrt(3.0 * sigma_a * (sigma_s + sigma_a));
  }
  static ScatteringPoint found(double sigma_s, double sigma_a, double scale, bool has_free_scale) {
    const double farthest_mm = std::min(15.0, std::log(50.0) / per_reach_mm(sigma_s, sigma_a));
    const Eigen::ArrayXd d_mm = Eigen::ArrayXd::LinSpaced(64, 0.03 * farthest_mm, farthest_mm);
    const auto light = [&](double s, double a) -> Eigen::ArrayXd {
      return s * (-per_reach_mm(s, a) * d_mm).exp() / (1.0 + s * d_mm).square();
    };
    const Eigen::ArrayXd truth = scale * light(sigma_s, sigma_a);
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise(0.0, 0.1);
    // Dark parts hold hardly more than noise.
    const double floor = 0.01 * truth.maxCoeff() / scale;
    return nearest_point(20.0, has_free_scale, truth, [&](int node, double a) {
      Eigen::ArrayXd out = light(TransportAtlas::sigma_s_per_mm(node), a);
      for (Eigen::Index i = 0; i < out.size(); ++i) {
        out[i] = (out[i] * (1.0 + noise(random)) + floor * noise(random)) / truth[i];
      }
      return out;
    });
  }
};

// Nodes are 0.7 apart in log sigma_s, and sigma_a between its grid's points shifts the nearest.
TEST_P(NearestPoint, IsWithinAStepAndAHalfOfTheMedium) {
  const double sigma_s = GetParam();
  for (const double dark : {2e-4, 0.005, 0.2, 0.6}) {
    for (const bool has_free_scale : {false, true}) {
      const double scale = has_free_scale ? 3.0 : 1.0;
      const ScatteringPoint at = found(sigma_s, dark * sigma_s, scale, has_free_scale);
      EXPECT_NEAR(std::log(at.sigma_s_per_mm / sigma_s), 0.0, 1.05) << dark << has_free_scale;
      EXPECT_NEAR(at.scale, scale, has_free_scale ? scale : 0.0) << dark;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Media, NearestPoint, ::testing::Values(0.3, 1.0, 2.5, 9.0));

// Nearest is the node of about 1 per mm, whatever sigma_a.
ScatteringPoint started_from(const Estimate& estimate) {
  const Eigen::ArrayXd even = Eigen::ArrayXd::Ones(4);
  return starting_point(estimate, 20.0, false, even, [&](int node, double) -> Eigen::ArrayXd {
    return TransportAtlas::sigma_s_per_mm(node) * even;
  });
}

TEST(StartingPoint, IsTheDipolesUnlessItMissesTheImageByFar) {
  Estimate dipole;
  dipole.sigma_s_prime_per_mm = normal_quantity(0.42, 0.07);
  dipole.sigma_a_per_mm = normal_quantity(0.003, 0.001);
  dipole.misfit_p_value = 1e-9;
  dipole.misfit_relative = 0.004;
  EXPECT_EQ(started_from(dipole).sigma_s_per_mm, 0.42);
  EXPECT_EQ(started_from(dipole).sigma_a_per_mm, 0.003);
  dipole.misfit_relative = 0.012;
  EXPECT_NEAR(std::log(started_from(dipole).sigma_s_per_mm), 0.0, 0.36);
}

TEST(StartingPoint, IsTheNearestWhereTheDipoleDeterminesNothing) {
  Estimate dipole;
  dipole.sigma_s_prime_per_mm = normal_quantity(0.42, 0.3);
  EXPECT_NEAR(std::log(started_from(dipole).sigma_s_per_mm), 0.0, 0.36);
}

TEST(StartingPoint, IsFiveMeanFreePathsAcrossAtLeast) {
  Estimate dipole;
  dipole.sigma_s_prime_per_mm = normal_quantity(0.1, 0.01);
  EXPECT_EQ(started_from(dipole).sigma_s_per_mm, 0.25);
}

}  // namespace
}  // namespace scattermeter
