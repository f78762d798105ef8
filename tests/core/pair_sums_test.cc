#include "core/pair_sums.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/dipole.h"
#include "core/distance_weights.h"
#include "tests/core/boxes.h"

namespace scattermeter {
namespace {

// Light that falls evenly on the part x > edge_mm of the top of a plate, 1 sr/mm^2 behind the
// surface.
IncidentLight half_lit_top(const PatchMesh& patches, double edge_mm) {
  IncidentLight light;
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).z() < 0.5 || patches.center_mm(k).x() < edge_mm) continue;
    light.lit.push_back({patches.corners_mm(k), {1.0, 1.0, 1.0}, k});
  }
  return light;
}

// The same by one-dimensional quadrature in polar coordinates about a point at distance x inside
// the edge (x < 0: outside): ∫ R(rho) rho phi(rho) d rho, where phi is the lit angle at radius rho.
double half_plane(const Dipole& dipole, double x, double rho_max) {
  const int n = 400'000;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    // rho = exp-spaced for the peak at the origin.
    const double a = std::log(1e-6);
    const double b = std::log(rho_max);
    const double rho = std::exp(a + (i + 0.5) / n * (b - a));
    double phi = x > 0 ? 2.0 * std::numbers::pi : 0.0;
    if (rho > std::abs(x)) {
      const double cut = 2.0 * std::acos(std::abs(x) / rho);
      phi += x > 0 ? -cut : cut;
    }
    sum += dipole.reflectance_per_mm2(rho) * rho * rho * phi * (b - a) / n;
  }
  return sum;
}

struct Case {
  double patch_mm;
  double z_r_mm;
};

class PairSums : public ::testing::TestWithParam<Case> {};

// A plate, lit on one side of a straight edge; sites across the edge. The truth is a quadrature
// that shares nothing with the patches. z_r from a fifth of the patch to five patches.
TEST_P(PairSums, AgreeWithPolarQuadratureAcrossAShadowEdge) {
  const Case c = GetParam();
  const double sigma_t = 1.0 / c.z_r_mm;
  // sigma_tr = 10 per 20 mm: the plate's far border holds less than exp(-10) of the light.
  const double sigma_a = 0.25 / (3.0 * sigma_t);
  const Dipole dipole({sigma_t - sigma_a, sigma_a, 1.3});
  const PatchMesh patches(testing::make_box({-24, -24, -2}, {24, 24, 0}), c.patch_mm);
  const SourceCloud sources(half_lit_top(patches, 0.0), {0, 0, 0});
  const DistanceKnots knots(c.z_r_mm, 70.0);
  std::vector<ExitSite> sites;
  std::vector<double> x;
  for (double at : {-2.0, -0.3, -0.02, 0.0, 0.02, 0.3, 2.0, 3.1}) {
    sites.push_back(exit_point({at, 0.123, 0.0}));
    x.push_back(at);
  }
  PairSumOptions options;
  options.floor_mm = c.z_r_mm / 8;
  const WeightMatrix w = smooth_weights(sites, sources, knots, options);
  Eigen::VectorXd r(knots.size());
  for (int i = 0; i < knots.size(); ++i) {
    r[i] = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
  }
  const Eigen::VectorXd l = w * r;
  const double total = dipole.total_reflectance();
  for (std::size_t j = 0; j < sites.size(); ++j) {
    const double truth = half_plane(dipole, x[j], 24.0);
    printf("patch %g z_r %g x %g: %.6f truth %.6f diff/total %.2e\n", c.patch_mm, c.z_r_mm, x[j],
           l[static_cast<Eigen::Index>(j)], truth,
           (l[static_cast<Eigen::Index>(j)] - truth) / total);
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, PairSums,
                         ::testing::Values(Case{0.5, 0.1}, Case{0.5, 0.46}, Case{0.5, 2.0},
                                           Case{0.25, 0.46}, Case{1.0, 0.46}));

}  // namespace
}  // namespace scattermeter
