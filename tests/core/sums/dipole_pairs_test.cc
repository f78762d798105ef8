#include "core/sums/dipole_pairs.h"

#include <cmath>
#include <random>
#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

// The dipole and its derivatives written out in long double, of each term's size as well: values,
// then sums of absolute values.
struct LongSum {
  long double v[3] = {0, 0, 0}, size[3] = {0, 0, 0};
};

LongSum long_sum(const Medium& m, const std::vector<Eigen::Vector3d>& points,
                 const std::vector<double>& weights, const Eigen::Vector3d& site) {
  using L = long double;
  const L s = m.sigma_s_prime_per_mm, a = m.sigma_a_per_mm, t = s + a;
  const L zr = 1 / t, k = 1 + 4.0L / 3 * L(boundary_mismatch(m.eta_int_over_ext));
  const L kappa2 = 3 * a * t, kappa = std::sqrt(kappa2);
  const L pi = std::acos(L(-1));
  LongSum out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    L d2 = 0;
    for (int c = 0; c < 3; ++c) {
      const L d = L(points[i][c]) - L(site[c]);
      d2 += d * d;
    }
    L f = 0, f_t = 0, f_kappa2 = 0;
    for (const L z : {zr, zr * k}) {
      const L rho2 = d2 + z * z, rho = std::sqrt(rho2), e = std::exp(-kappa * rho);
      f += z * (1 + kappa * rho) * e / (rho2 * rho);
      // By z, times dz/dt = -z / t.
      f_t -= z / t * e / (rho2 * rho) *
             (1 + kappa * rho - z * z / rho2 * (3 * (1 + kappa * rho) + kappa2 * rho2));
      f_kappa2 -= z * e / (2 * rho);
    }
    const L scale = L(weights[i]) / (4 * pi);
    const L terms[3] = {scale * s / t * f,
                        scale * (a / (t * t) * f + s / t * (f_t + 3 * a * f_kappa2)),
                        scale * (-s / (t * t) * f + s / t * (f_t + 3 * (t + a) * f_kappa2))};
    for (int c = 0; c < 3; ++c) {
      out.v[c] += terms[c];
      out.size[c] += std::abs(terms[c]);
    }
  }
  return out;
}

using Params = std::tuple<double, double, double>;  // sigma_s', sigma_a, size of the scene in mm
class DipolePairsAccuracy : public testing::TestWithParam<Params> {};

// Against long double, for media and scenes of any size, far from the world's origin, with points
// that coincide with the site.
TEST_P(DipolePairsAccuracy, SinglePrecisionWillDo) {
  const auto [sigma_s, sigma_a, size] = GetParam();
  const Medium medium{sigma_s, sigma_a, 1.3};
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  const Eigen::Vector3d far(300.0 * size, -200.0 * size, 1000.0 * size);
  std::vector<Eigen::Vector3d> points;
  std::vector<double> weights;
  for (int i = 0; i < 3000; ++i) {
    // Neighbours stand together, as a tree's leaves do.
    const Eigen::Vector3d corner(0.1 * size * (i / 300), 0.1 * size * (i / 300 % 3), 0.0);
    points.emplace_back(
        far + corner +
        0.1 * size * Eigen::Vector3d(uniform(random), uniform(random), 0.1 * uniform(random)));
    weights.push_back(1e-3 * (0.5 + uniform(random)));
  }
  const std::vector<Eigen::Vector3d> sites = {points[0], points[1700],
                                              far + size * Eigen::Vector3d(0.3, 0.2, 0.4)};
  std::vector<DipoleSum> sums(sites.size());
  const PairSources sources(points, weights);
  EXPECT_EQ(sources.size(), points.size());
  DipolePairs(medium).sum(sources, sites, sums);
  const LongSum all_here =
      long_sum(medium, std::vector<Eigen::Vector3d>(points.size(), far), weights, far);
  for (std::size_t j = 0; j < sites.size(); ++j) {
    const LongSum truth = long_sum(medium, points, weights, sites[j]);
    const double got[3] = {sums[j].value, sums[j].per_sigma_s_prime, sums[j].per_sigma_a};
    for (int c = 0; c < 3; ++c) {
      EXPECT_LE(std::abs(got[c] - double(truth.v[c])),
                1e-6 * double(truth.size[c]) + 1e-37 * double(all_here.size[c]))
          << "quantity " << c << " site " << j << ": off by "
          << std::abs(got[c] - double(truth.v[c])) / double(truth.size[c]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, DipolePairsAccuracy,
                         testing::Values(Params{2.19, 0.002, 20.0}, Params{0.15, 0.02, 20.0},
                                         Params{50.0, 0.0, 20.0}, Params{1.0, 1.0, 20.0},
                                         Params{2.19, 0.002, 2e4}, Params{2.19e-3, 2e-6, 2e4},
                                         Params{2.19, 0.002, 0.02}, Params{2190.0, 2.0, 0.02}));

// The same kernel as the double one.
TEST(DipolePairs, AgreesWithDipole) {
  const Medium medium{1.2, 0.03, 1.49};
  const Dipole dipole(medium);
  for (const double d : {0.0, 0.01, 0.5, 3.0, 30.0}) {
    const std::vector<Eigen::Vector3d> points = {{d, 0, 0}};
    const std::vector<double> weights = {2.5};
    const std::vector<Eigen::Vector3d> sites = {Eigen::Vector3d::Zero()};
    DipoleSum sum;
    DipolePairs(medium).sum(PairSources(points, weights), sites, {&sum, 1});
    const Dipole::Value truth = dipole.with_derivatives(d);
    const double tolerance = 3e-6;  // a single pair, its exponential's argument rounded
    EXPECT_NEAR(sum.value, 2.5 * truth.r_per_mm2, tolerance * std::abs(sum.value));
    EXPECT_NEAR(sum.per_sigma_a, 2.5 * truth.d_sigma_a, tolerance * std::abs(sum.per_sigma_a));
    EXPECT_NEAR(sum.per_sigma_s_prime, 2.5 * truth.d_sigma_s_prime,
                tolerance * (std::abs(sum.per_sigma_s_prime) + sum.value));
  }
}

TEST(DipolePairs, EmptyAndBad) {
  const std::vector<Eigen::Vector3d> one = {{0, 0, 0}};
  const std::vector<double> none;
  DipoleSum sum{1, 1, 1};
  DipolePairs(Medium{1.0, 0.0, 1.3}).sum(PairSources({}, {}), one, {&sum, 1});
  EXPECT_EQ(sum.value, 0.0);
  EXPECT_THROW(PairSources(one, none), std::invalid_argument);
  const std::vector<double> bad = {std::nan("")};
  EXPECT_THROW(PairSources(one, bad), std::invalid_argument);
  EXPECT_THROW(DipolePairs(Medium{0.0, 0.0, 1.3}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
