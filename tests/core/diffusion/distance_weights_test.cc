#include "core/diffusion/distance_weights.h"

#include <array>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "core/material/dipole.h"
#include "tests/fixtures/core/boxes.h"

namespace scattermeter {
namespace {

// A pair at any distance: sum of folded weights times R on the knots is R there.
TEST(DistanceKnots, InterpolateTheDipole) {
  for (const Medium& m :
       {Medium{2.19, 0.002, 1.3}, Medium{9.0, 0.0002, 1.3}, Medium{0.74, 0.3, 1.3}}) {
    const Dipole dipole(m);
    const DistanceKnots knots(std::min(0.05, dipole.z_r_mm()), 40.0);
    const double at_zero = dipole.reflectance_per_mm2(0.0);
    for (double d = 0.0; d < 39.0; d = d * 1.03 + 0.003) {
      std::vector<float> fine(static_cast<std::size_t>(knots.fine_bins().sums()));
      std::vector<double> folded(static_cast<std::size_t>(knots.size()));
      const std::array<float, 16> d2 = {static_cast<float>(d * d)}, weight = {1.0F};
      knots.fine_bins().add(d2.data(), weight.data(), 1, fine.data());
      knots.fold(fine.data(), folded.data());
      double r = 0.0;
      for (int i = 0; i < knots.size(); ++i) {
        r += folded[static_cast<std::size_t>(i)] *
             dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
      }
      const double truth = dipole.reflectance_per_mm2(d);
      // Two thirds of it from the fine bins, whose error is one-sided and at most (15/32) 4^-7
      // = 2.9e-5; far out, where R has fallen by many orders, the exponential bends more.
      EXPECT_NEAR(r, truth, 5e-5 * truth + 1e-7 * at_zero) << "d " << d;
    }
  }
}

TEST(DistanceKnots, RefusesWhatHasNoRange) {
  EXPECT_THROW(DistanceKnots(0.0, 10.0), std::invalid_argument);
  EXPECT_THROW(DistanceKnots(1.0, 0.5), std::invalid_argument);
}

IncidentLight lit_top(const PatchMesh& patches) {
  IncidentLight light;
  for (int k = 0; k < patches.size(); ++k) {
    if (patches.normal(k).z() > 0.5) light.lit.push_back({patches.corners_mm(k), {1, 2, 3}, k});
  }
  return light;
}

// Images without W between: rows and columns of any number.
TEST(DistanceWeights, ImagesAreThoseOfW) {
  const PatchMesh patches(test_support::make_cube(), 1.0);
  const SourceCloud sources(lit_top(patches), {0, 0, 10});
  std::vector<ExitSite> sites;
  for (int k = 0; k < patches.size(); k += 11) sites.push_back(exit_patch(patches, k));
  const DistanceKnots knots(0.1, 36.0);
  Eigen::MatrixXd r(knots.size(), 3);
  for (Eigen::Index i = 0; i < r.rows(); ++i) {
    const double d = knots.knots_mm()[static_cast<std::size_t>(i)];
    r.row(i) << std::exp(-d), 1.0 / (1.0 + d), d;
  }
  const Eigen::MatrixXd image = smooth_images(sites, sources, knots, {}, r);
  const Eigen::MatrixXd by_weights = smooth_weights(sites, sources, knots, {}) * r;
  EXPECT_LT((image - by_weights).cwiseAbs().maxCoeff(), 1e-12 * by_weights.maxCoeff());
}

// The paper's system and the smooth one predict the same image for a function that both represent:
// R itself where the width is far below its scale.
TEST(DistanceWeights, UniformAndSmoothAgree) {
  const Dipole dipole({0.8, 0.01, 1.3});
  const PatchMesh patches(test_support::make_cube(), 1.0);
  const SourceCloud sources(lit_top(patches), {0, 0, 10});
  std::vector<ExitSite> sites;
  for (int k = 0; k < patches.size(); k += 7) sites.push_back(exit_patch(patches, k));
  PairSumOptions options;
  options.floor_mm = 0.05;
  const DistanceKnots knots(0.1, 36.0);
  const UniformBins bins(0.02, 36.0);
  Eigen::VectorXd smooth(knots.size()), uniform(bins.size());
  for (int i = 0; i < knots.size(); ++i) {
    smooth[i] = dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
  }
  for (int i = 0; i < bins.size(); ++i) uniform[i] = dipole.reflectance_per_mm2(bins.knot_mm(i));
  const Eigen::VectorXd a = smooth_weights(sites, sources, knots, options) * smooth;
  const Eigen::VectorXd b = uniform_weights(sites, sources, bins, options) * uniform;
  // Linear interpolation over 0.02 mm at z_r = 1.23 mm: 0.02^2 / 8 * R'' / R < 2e-4.
  for (Eigen::Index j = 0; j < a.size(); ++j) EXPECT_NEAR(a[j], b[j], 3e-4 * b[j]);
}

TEST(DistanceWeights, SameDigitsForAnyNumberOfThreads) {
  const PatchMesh patches(test_support::make_cube(), 1.5);
  const SourceCloud sources(lit_top(patches), {0, 0, 10});
  std::vector<ExitSite> sites;
  for (int k = 0; k < patches.size(); ++k) sites.push_back(exit_patch(patches, k));
  const DistanceKnots knots(0.1, 36.0);
  WeightMatrix one, many;
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
    one = smooth_weights(sites, sources, knots, {});
  }
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
    many = smooth_weights(sites, sources, knots, {});
  }
  EXPECT_EQ(one, many);
}

}  // namespace
}  // namespace scattermeter
