#include "core/transport/white_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/fixtures/core/rows_scene.h"

namespace scattermeter {
namespace {

constexpr double kSigmaS = 1.2;

struct WhiteScene : test_support::RowsScene {
  using RowsScene::RowsScene;
  WhiteRows rows(int levels, std::uint64_t seed = 4) const {
    WhiteRows out(view, kSigmaS, boundary.size_mm());
    const ScatteringMedium medium{kSigmaS, 0.0, 0.0, 1.3};
    const CameraConnection seen_from = camera(medium);
    while (out.levels() < levels) out.refine({boundary, medium, *source, &seen_from}, seed);
    return out;
  }
};

// Of the rows that the camera sees.
double chi2_per_row(const Eigen::VectorXd& difference, const Eigen::VectorXd& variance) {
  const Eigen::ArrayXd seen = (variance.array() > 0.0).cast<double>();
  return (seen * difference.array().square() / variance.array().max(1e-300)).sum() / seen.sum();
}

// At any absorption, the light is that of paths which are absorbed as they go.
TEST(WhiteRows, LightIsThatOfAbsorbedPaths) {
  const WhiteScene s;
  const WhiteRows white = s.rows(13);
  for (const double sigma_a : {0.0, 0.003, 0.05, 0.6}) {
    const ScatteringImage direct = s.sum({kSigmaS, sigma_a, 0.0, 1.3}, 9, 300).image();
    const WhiteRows::Light light = white.light(sigma_a);
    const Eigen::VectorXd variance =
        direct.variance + white.departures(sigma_a).of_batch.colwise().squaredNorm().transpose();
    const double chi2 = chi2_per_row(light.l - direct.l, variance);
    EXPECT_GT(chi2, 0.6) << sigma_a;
    EXPECT_LT(chi2, 1.5) << sigma_a;
    const double all = s.view.area_mm2.dot(direct.l);
    EXPECT_NEAR(s.view.area_mm2.dot(light.l) / all, 1.0, 0.01) << sigma_a;
    EXPECT_NEAR(s.view.area_mm2.dot(light.per_sigma_a) / s.view.area_mm2.dot(direct.per_sigma_a),
                1.0, 0.05)
        << sigma_a;
  }
}

TEST(WhiteRows, DeparturesAreTheSpreadOverSeeds) {
  const WhiteScene s;
  const WhiteRows a = s.rows(1, 100), b = s.rows(1, 200);
  const Eigen::VectorXd variance = a.departures(0.01).of_batch.colwise().squaredNorm().transpose() +
                                   b.departures(0.01).of_batch.colwise().squaredNorm().transpose();
  const double chi2 = chi2_per_row(a.light(0.01).l - b.light(0.01).l, variance);
  EXPECT_GT(chi2, 0.6);
  EXPECT_LT(chi2, 1.6);
}

// The second half departs from all paths as its own spread says, and its derivative by absorption
// is that of its light.
TEST(WhiteRows, HalvesAreIndependent) {
  const WhiteScene s;
  const WhiteRows white = s.rows(5);
  const WhiteRows::Departures d = white.departures(0.02);
  constexpr Eigen::Index kHalf = WhiteRows::kBatches / 2;
  const double size = d.of_batch.cwiseAbs().maxCoeff();
  EXPECT_LT(d.of_batch.topRows(kHalf).colwise().sum().cwiseAbs().maxCoeff(), 1e-5 * size);
  EXPECT_LT(d.of_batch.bottomRows(kHalf).colwise().sum().cwiseAbs().maxCoeff(), 1e-5 * size);
  const double chi2 = chi2_per_row(d.second_half.l, d.of_batch.colwise().squaredNorm().transpose());
  EXPECT_GT(chi2, 0.6);
  EXPECT_LT(chi2, 1.6);
  constexpr double kStep = 1e-3;
  const Eigen::VectorXd by_step = (white.departures(0.02 + kStep).second_half.l -
                                   white.departures(0.02 - kStep).second_half.l) /
                                  (2.0 * kStep);
  EXPECT_LT((by_step - d.second_half.per_sigma_a).norm(), 0.1 * by_step.norm());
}

TEST(WhiteRows, FourLevelsDoubleThePaths) {
  const WhiteScene s;
  EXPECT_EQ(s.rows(0).paths(), 0);
  const WhiteRows first = s.rows(1), ninth = s.rows(9), again = s.rows(9);
  EXPECT_EQ(first.paths(), WhiteRows::kFirstPaths);
  EXPECT_EQ(ninth.paths(), 4 * WhiteRows::kFirstPaths);
  EXPECT_EQ(ninth.light(0.02).l, again.light(0.02).l);
  const double finer = ninth.departures(0.02).of_batch.squaredNorm();
  EXPECT_NEAR(first.departures(0.02).of_batch.squaredNorm() / finer, 4.0, 1.2);
  EXPECT_EQ(WhiteRows::levels_for(1.0), 1);
  EXPECT_EQ(WhiteRows::levels_for(WhiteRows::kFirstPaths + 1.0), 2);
  EXPECT_EQ(WhiteRows::paths_of(2) % WhiteRows::kBatches, 0);
}

// The change by eta is that between paths of two eta, but for what moves across edges as light is
// refracted otherwise: 0.05 to 0.1 of the light per unit of eta, on a box of 24 mean free paths.
TEST(WhiteRows, ChangeByEtaIsThatOfPaths) {
  constexpr double kDense = 6.0, kIndex = 1.45, kStep = 0.1;
  const WhiteScene s;
  for (const double alpha : {0.0, 0.3}) {
    const auto rows = [&](double eta, std::uint64_t seed) {
      WhiteRows out(s.view, kDense, s.boundary.size_mm());
      const ScatteringMedium medium{kDense, 0.0, 0.0, eta, alpha};
      const auto source = led_entry(s.rays, s.led, eta);
      const CameraConnection seen_from = s.camera(medium);
      while (out.levels() < 13) out.refine({s.boundary, medium, *source, &seen_from}, seed);
      return out;
    };
    const WhiteRows less = rows(kIndex - kStep, 1), nominal = rows(kIndex, 2),
                    more = rows(kIndex + kStep, 3);
    for (const double sigma_a : {0.0, 0.1, 1.0}) {
      const auto light = [&](const WhiteRows& of) {
        return s.view.area_mm2.dot(of.light(sigma_a).l);
      };
      const WhiteRows::Light at = nominal.light(sigma_a);
      const double by_scores =
          s.view.area_mm2.dot(nominal.per_eta(sigma_a)) / s.view.area_mm2.dot(at.l);
      const double by_paths = (light(more) - light(less)) / (2.0 * kStep * light(nominal));
      EXPECT_NEAR(by_scores, by_paths, 0.15) << alpha << " " << sigma_a;
      EXPECT_LT(by_paths, sigma_a < 1.0 ? 0.1 : -0.7) << alpha;
    }
  }
}

// Light that leaves falls on the body again by its direction outside, which a direction held inside
// would turn: that is 0.15 of the light per unit of eta on this body with two concave edges.
TEST(WhiteRows, ChangeByEtaOfLightThatFallsBack) {
  constexpr double kSigma = 4.0, kIndex = 1.45, kStep = 0.06;
  const WhiteScene s(test_support::make_prism(
      {{-3, 2}, {-3, 0}, {-1.5, 0}, {0, -3}, {1.5, 0}, {3, 0}, {3, 2}}, 5));
  const auto rows = [&](double eta) {
    WhiteRows out(s.view, kSigma, s.boundary.size_mm());
    const ScatteringMedium medium{kSigma, 0.0, 0.0, eta};
    const auto source = led_entry(s.rays, s.led, eta);
    const CameraConnection seen_from = s.camera(medium);
    while (out.levels() < 17) out.refine({s.boundary, medium, *source, &seen_from}, 1);
    return out;
  };
  const WhiteRows less = rows(kIndex - kStep), nominal = rows(kIndex), more = rows(kIndex + kStep);
  for (const double sigma_a : {0.0, 0.03}) {
    const auto sum = [&](const Eigen::VectorXd& l) { return s.view.area_mm2.dot(l); };
    const double light = sum(nominal.light(sigma_a).l);
    const double by_scores = sum(nominal.per_eta(sigma_a)) / light;
    const double by_paths =
        (sum(more.light(sigma_a).l) - sum(less.light(sigma_a).l)) / (2.0 * kStep * light);
    EXPECT_NEAR(by_scores, by_paths, 0.08) << sigma_a;
  }
}

// Of an equal object with more paths only.
TEST(WhiteRows, TakesMorePaths) {
  const WhiteScene s;
  WhiteRows rows = s.rows(1);
  const WhiteRows more = s.rows(2);
  EXPECT_FALSE(rows.take(rows.sums()));
  WhiteSums other = more.sums();
  other.batches.steps.pop_back();
  EXPECT_FALSE(rows.take(other));
  EXPECT_EQ(rows.levels(), 1);
  EXPECT_TRUE(rows.take(more.sums()));
  EXPECT_EQ(rows.light(0.01).l, more.light(0.01).l);
}

}  // namespace
}  // namespace scattermeter
