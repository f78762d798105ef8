#include "core/estimation/channel_simulation.h"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "tests/fixtures/core/simulated_cube.h"

namespace scattermeter {
namespace {

using test_support::kSimulated;
using test_support::SimulatedCube;

TEST(ChannelSimulation, RowsAreTheUsedPatchesShotByShot) {
  SimulatedCube c;
  const SeenObject& seen = *c.cube.shots[0].seen;
  std::size_t at = 0;
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t j = 0; j < c.rows[s].state.size(); ++j) {
      if (c.rows[s].state[j] != RowState::kUsed) continue;
      const int patch = seen.map.patch_of_row[j];
      ASSERT_LT(at, c.simulation->area_mm2().size());
      EXPECT_EQ(c.simulation->area_mm2()[at], seen.patches->area_mm2(patch));
      EXPECT_EQ(c.simulation->center_mm()[at], seen.patches->center_mm(patch));
      ++at;
    }
  }
  EXPECT_EQ(c.simulation->n_rows(), static_cast<Eigen::Index>(at));
}

// Each row's variance is that of the identity's projection, and no two lights share paths.
TEST(ChannelSimulation, CovarianceOfTheRowsHoldsTheirVariances) {
  SimulatedCube c;
  const ChannelSimulation::Look look = c.look(3);
  EXPECT_GE(look.blocks, 3);
  EXPECT_GE(look.freedom, WhiteRows::kBatches - 2.0);
  const ScatteringImage& image = look.image;
  ASSERT_EQ(image.l.size(), c.simulation->n_rows());
  EXPECT_GT(image.l.minCoeff(), 0.0);
  EXPECT_LT((look.covariance.diagonal() - image.variance).norm(), 1e-9 * image.variance.norm());
  const auto first = static_cast<Eigen::Index>(c.rows[0].rows_used);
  EXPECT_EQ(look.covariance.topRightCorner(first, look.covariance.cols() - first).norm(), 0.0);
}

// The halves are images themselves, whose mean is the image, and err as their covariances say.
TEST(ChannelSimulation, HalvesAreIndependentImages) {
  SimulatedCube c;
  const ChannelSimulation::Look look = c.look(3);
  const PathHalves& h = look.halves;
  EXPECT_LT((0.5 * (h[0].l + h[1].l) - look.image.l).norm(), 1e-12 * look.image.l.norm());
  EXPECT_LT((0.5 * (h[0].per_sigma_a + h[1].per_sigma_a) - look.image.per_sigma_a).norm(),
            1e-12 * look.image.per_sigma_a.norm());
  const Eigen::ArrayXd apart = 0.5 * (h[0].l - h[1].l).array();
  const double chi2 = (apart.square() / look.image.variance.array()).mean();
  EXPECT_GT(chi2, 0.3);
  EXPECT_LT(chi2, 2.5);
  EXPECT_LT((0.5 * (look.by_half[0] + look.by_half[1]) - look.covariance).norm(),
            1e-12 * look.covariance.norm());
  EXPECT_NEAR(look.by_half[0].trace() / look.by_half[1].trace(), 1.0, 0.5);
}

// Lit by 3 W/sr instead of 1: the same paths, three times the light, nine times the variance.
TEST(ChannelSimulation, LightIsProportionalToPower) {
  SimulatedCube one, three(3.0);
  const ScatteringImage a = one.look(2).image;
  const ScatteringImage b = three.look(2).image;
  ASSERT_EQ(a.l.size(), b.l.size());
  EXPECT_LT((3.0 * a.l - b.l).norm(), 1e-12 * b.l.norm());
  EXPECT_LT((3.0 * a.per_log_sigma_s - b.per_log_sigma_s).norm(), 1e-11 * b.per_log_sigma_s.norm());
  EXPECT_LT((3.0 * a.per_sigma_a - b.per_sigma_a).norm(), 1e-11 * b.per_sigma_a.norm());
  EXPECT_LT((9.0 * a.variance - b.variance).norm(), 1e-12 * b.variance.norm());
}

TEST(ChannelSimulation, ShotsUnderOneLightShareItsPaths) {
  SimulatedCube c(1.0, true);
  const ScatteringImage image = c.look(2).image;
  const Eigen::Index half = image.l.size() / 2;
  ASSERT_EQ(c.rows[0].rows_used, c.rows[1].rows_used);
  EXPECT_EQ(image.l.head(half), image.l.tail(half));
}

TEST(ChannelSimulation, TracesWhatIsMissing) {
  SimulatedCube c;
  const std::int64_t missing = c.simulation->missing_paths(kSimulated, 8);
  EXPECT_GT(missing, static_cast<std::int64_t>(2 * 8 * ChannelSimulation::kBlockPaths));
  const ChannelSimulation::Look look = c.look(8);
  EXPECT_GE(look.blocks, 8);
  EXPECT_EQ(c.simulation->missing_paths(kSimulated, 8), 0);
  EXPECT_EQ(c.look(8).image.l, look.image.l);
  EXPECT_GT(c.simulation->missing_paths(kSimulated, 32), 0);
  const double before = look.covariance.trace();
  EXPECT_LT(c.look(32).covariance.trace(), 0.5 * before);
}

// Of the interpolated light itself: the paths stay the same.
TEST(ChannelSimulation, DerivativesAreThoseOfTheLight) {
  SimulatedCube c;
  const ScatteringImage image = c.look(4).image;
  const auto light = [&](double log_step, double a_step) {
    return c
        .look(4,
              {kSimulated.sigma_s_per_mm * std::exp(log_step), kSimulated.sigma_a_per_mm + a_step})
        .image.l;
  };
  constexpr double kLog = 1e-3, kAbsorption = 1e-4;
  const Eigen::VectorXd by_s = (light(kLog, 0) - light(-kLog, 0)) / (2.0 * kLog);
  const Eigen::VectorXd by_a =
      (light(0, kAbsorption) - light(0, -kAbsorption)) / (2.0 * kAbsorption);
  EXPECT_LT((by_s - image.per_log_sigma_s).norm(), 1e-4 * by_s.norm());
  EXPECT_LT((by_a - image.per_sigma_a).norm(), 0.01 * by_a.norm());
}

}  // namespace
}  // namespace scattermeter
