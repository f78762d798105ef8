#include "core/transport/scattering_rows.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "core/transport/patch_scores.h"
#include "tests/fixtures/core/rows_scene.h"

namespace scattermeter {
namespace {

using test_support::RowsScene;

// The rows' means times their areas are what the patches' scores add up to.
TEST(ScatteringRows, AreThePatchesScores) {
  const RowsScene s;
  const ScatteringMedium medium{1.0, 0.05, 0.0, 1.3};
  const ScatteringImage image = s.sum(medium, 3, 20).image();
  const CameraConnection camera(s.boundary, {0, -100, 150}, medium);
  PathOptions options = s.options;
  options.seed = 3;
  const PatchScores scores =
      patch_scores(s.patches, {s.boundary, medium, *s.source, &camera}, options, 0, 20);
  double total = 0.0;
  for (Eigen::Index j = 0; j < image.l.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const double area = s.view.area_mm2[j];
    const double scale = 1e-12 + 1e-9 * std::abs(scores.mean[k][0]);
    EXPECT_NEAR(image.l[j] * area, scores.mean[k][0], scale);
    EXPECT_NEAR(image.per_sigma_a[j] * area, -scores.mean[k][2], 10 * scale);
    EXPECT_NEAR(image.variance[j] * area * area, scores.covariance[k](0, 0),
                1e-6 * scores.covariance[k](0, 0) + 1e-18);
    total += image.l[j] * area;
  }
  EXPECT_GT(total, 0.0);
}

// Blocks traced in two calls are those of one.
TEST(ScatteringRows, GoOn) {
  const RowsScene s;
  const ScatteringMedium medium{1.0, 0.05, 0.0, 1.3};
  const ScatteringSum once = s.sum(medium, 5, 12);
  ScatteringSum twice = s.sum(medium, 5, 7);
  const CameraConnection camera(s.boundary, {0, -100, 150}, medium);
  PathOptions options = s.options;
  options.seed = 5;
  twice.trace({s.boundary, medium, *s.source, &camera}, options, 5);
  EXPECT_EQ(once.image().l, twice.image().l);
  EXPECT_EQ(once.projected_covariance(), twice.projected_covariance());
  const ScatteringMedium other{1.1, 0.05, 0.0, 1.3};
  EXPECT_THROW(twice.trace({s.boundary, other, *s.source, &camera}, options, 5),
               std::invalid_argument);
}

// Derivatives of the light toward the camera against differences of independent simulations, to
// four standard errors of those.
TEST(ScatteringRows, DerivativesAreThoseOfTheMedium) {
  const RowsScene s;
  constexpr int kBlocks = 150;
  const auto total = [&](const ScatteringMedium& m, std::uint64_t seed) {
    const ScatteringSum sum = s.sum(m, seed, kBlocks);
    return std::pair(sum.image().l.dot(s.view.area_mm2),
                     std::sqrt(sum.projected_covariance()(0, 0)));
  };
  const ScatteringImage at = s.sum({1.0, 0.1, 0.0, 1.3}, 1, kBlocks).image();
  const auto [more_s, more_s_std] = total({1.3, 0.1, 0.0, 1.3}, 2);
  const auto [less_s, less_s_std] = total({1.0 / 1.3, 0.1, 0.0, 1.3}, 3);
  const double step = 2.0 * std::log(1.3);
  // A share of 0.05 for the curvature over the step.
  const double by_s = at.per_log_sigma_s.dot(s.view.area_mm2);
  EXPECT_NEAR(by_s, (more_s - less_s) / step,
              4.0 * std::hypot(more_s_std, less_s_std) / step + 0.05 * by_s);
  const auto [more_a, more_a_std] = total({1.0, 0.13, 0.0, 1.3}, 4);
  const auto [less_a, less_a_std] = total({1.0, 0.07, 0.0, 1.3}, 5);
  const double by_a = at.per_sigma_a.dot(s.view.area_mm2);
  EXPECT_LT(by_a, 0.0);
  EXPECT_NEAR(by_a, (more_a - less_a) / 0.06,
              4.0 * std::hypot(more_a_std, less_a_std) / 0.06 + 0.05 * std::abs(by_a));
}

}  // namespace
}  // namespace scattermeter
