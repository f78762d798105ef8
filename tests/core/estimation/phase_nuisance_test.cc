#include "core/estimation/phase_nuisance.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/scene/surroundings.h"
#include "tests/fixtures/core/dipole_cube.h"
#include "tests/fixtures/core/traced_image.h"

namespace scattermeter {
namespace {

// Paths of isotropic scattering and of Henyey and Greenstein's with g = 0.7: the light of the whole
// image, and of its rows. Their chi-square is 4.4 a row without the nuisance, and 1.4 with it.
TEST(PhaseNuisance, IsThatOfPaths) {
  const Medium medium{0.9, 0.01, 1.3};
  test_support::DipoleCube cube(1, 2.5);
  cube.show(medium);
  const SeenObject& seen = *cube.shots[0].seen;
  const auto paths = [&](const PhaseFunction& phase, std::uint64_t seed) {
    constexpr int kBlocks = 150;
    return test_support::traced_image(seen, cube.scene.lights[0].led()->led,
                                      scattering_medium(medium, phase),
                                      plane_below(cube.scene, *seen.object).in(0), seed, kBlocks);
  };
  const MaterialChannel channel = material_channels(cube.scene, cube.shots, "R").front();
  ChannelRows rows = channel_rows(cube.scene, channel);
  for (ChannelObservation& o : rows) {
    std::fill(o.state.begin(), o.state.end(), RowState::kUsed);
  }
  const DistanceKnots knots = smooth_knots(cube.lit);
  PhaseNuisance nuisance(cube.scene, channel, knots);
  nuisance.set_rows(rows);
  const WeightMatrix& weights = cube.weights.at({&seen, "led", 0});
  const ScatteringPoint at{medium.sigma_s_prime_per_mm, medium.sigma_a_per_mm, 1.0};
  const double power = cube.scene.lights[0]->power()[0];
  constexpr double kG = 0.7;
  const Eigen::VectorXd expected = kG * nuisance.change(weights, at);
  const ScatteringImage even = paths(0.0, 1), ahead = paths(kG, 2);
  const Eigen::VectorXd change = ahead.l - even.l;
  const Eigen::VectorXd variance = even.variance + ahead.variance;
  const auto n = static_cast<double>(change.size());
  const double without = change.cwiseAbs2().cwiseQuotient(variance).sum() / n;
  const double with = (change - expected).cwiseAbs2().cwiseQuotient(variance).sum() / n;
  EXPECT_NEAR(power, 1.0, 1e-12);
  EXPECT_GT(without, 3.0);
  EXPECT_LT(with, 1.8);
  EXPECT_NEAR(expected.sum() / even.l.sum(), change.sum() / even.l.sum(), 0.012);
}

}  // namespace
}  // namespace scattermeter
