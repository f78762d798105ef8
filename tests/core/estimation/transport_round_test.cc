#include "core/estimation/transport_round.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/estimation/transport_pilot.h"
#include "tests/fixtures/core/dipole_cube.h"

namespace scattermeter {
namespace {

constexpr ScatteringPoint kRoundPoint{0.9, 0.01, 1.0};
constexpr int kRoundBlocks = 2;

// Two shots that show exactly what the simulation predicts of them.
class RoundOfTheCube : public ::testing::Test {
 protected:
  RoundOfTheCube() {
    cube_.show(test_support::kCubeMedium, 0.01);
    channel_ = material_channels(cube_.scene, cube_.shots, "R").front();
    rows_ = channel_rows(cube_.scene, channel_);
    system_ = channel_system(cube_.scene, channel_, rows_, cube_.weights, 0.0);
    simulation_.emplace(cube_.scene, channel_, atlas_);
    simulation_->set_rows(rows_);
    parts_ =
        ShotParts(system_.shot_rows, simulation_->center_mm(), simulation_->area_mm2(), system_.l);
    const ChannelSimulation::Look first = look({parts_.cells(), parts_.cells()});
    image_ = first.image;
    cell_covariance_ = first.covariance;
    system_.l = image_.l;
    round_.emplace(TransportShots{system_, parts_}, ScalePrior{0.02}, kRoundPoint, pilots(), 1.0);
  }

  ChannelSimulation::Look look(const ChannelSimulation::Projections& projections) const {
    return simulation_->look(
        kRoundPoint, kRoundBlocks, projections, [&](const ScatteringPoint& at) {
          return dipole_pilot(system_.weights, smooth_knots(cube_.lit), at, 1.3);
        });
  }
  std::array<TransportRound::Pilot, 2> pilots() const {
    ScatteringImage out = dipole_pilot(system_.weights, smooth_knots(cube_.lit), kRoundPoint, 1.3);
    std::vector<double> area_mm2;
    for (const auto& [s, row] : used()) {
      const SeenObject& seen = *cube_.shots[s].seen;
      area_mm2.push_back(seen.patches->area_mm2(seen.map.patch_of_row[row]));
    }
    out.variance = smooth_path_variance(out.l, area_mm2, image_.variance);
    const TransportRound::Pilot one{out, Eigen::MatrixXd::Zero(parts_.n_cells(), parts_.n_cells())};
    return {one, one};
  }
  std::vector<std::pair<std::size_t, std::size_t>> used() const {
    std::vector<std::pair<std::size_t, std::size_t>> out;
    for (std::size_t s = 0; s < rows_.size(); ++s) {
      for (std::size_t j = 0; j < rows_[s].state.size(); ++j) {
        if (rows_[s].state[j] == RowState::kUsed) out.emplace_back(s, j);
      }
    }
    return out;
  }
  // Both halves of the paths alike, as if there were no Monte Carlo error.
  void take() {
    ChannelSimulation::Look seen = look(round_->projections());
    seen.halves = {seen.image, seen.image};
    round_->take(std::move(seen));
  }

  test_support::DipoleCube cube_{2, 4.0};
  MaterialChannel channel_;
  ChannelRows rows_;
  DenseSystem system_;
  ShotParts parts_;
  ScatteringImage image_;
  Eigen::MatrixXd cell_covariance_;
  TransportAtlas atlas_;
  std::optional<ChannelSimulation> simulation_;
  std::optional<TransportRound> round_;
};

// Rows: of the joint instruments (two derivatives with their detail and without, and the light), of
// each shot's own, of the scale, of the cells.
TEST_F(RoundOfTheCube, ProjectionHoldsJointSinglesScaleAndCells) {
  const Eigen::MatrixXd p = round_->projections()[0];
  ASSERT_EQ(round_->shots(), (std::vector<std::size_t>{0, 1}));
  ASSERT_EQ(p.rows(), 5 + 2 * 5 + 1 + parts_.n_cells());
  EXPECT_EQ(p.topRows(5), round_->equation().projection(0));
  const Eigen::Index first = system_.shot_rows[0];
  EXPECT_EQ(round_->rows_of_shot(0), static_cast<std::size_t>(first));
  EXPECT_GT(p.block(5, 0, 5, first).rowwise().norm().minCoeff(), 0.0);
  EXPECT_EQ(p.block(5, first, 5, p.cols() - first).norm(), 0.0);
  EXPECT_EQ(p.block(10, 0, 5, first).norm(), 0.0);
  EXPECT_GT(p.block(10, first, 5, p.cols() - first).rowwise().norm().minCoeff(), 0.0);
  EXPECT_EQ(p.row(15), round_->equation().scale_form(0));
  EXPECT_EQ(p.bottomRows(parts_.n_cells()), Eigen::MatrixXd(parts_.cells()));
}

TEST_F(RoundOfTheCube, AnImageThatIsPredictedMovesNothing) {
  take();
  EXPECT_GE(round_->blocks(), kRoundBlocks);
  EXPECT_LT((round_->image().l - image_.l).norm(), 1e-12 * image_.l.norm());
  EXPECT_LT(round_->residual().norm(), 1e-9 * image_.l.norm());
  EXPECT_LT(round_->step().move.norm(), 1e-9);
  EXPECT_EQ(round_->scatter(), 1.0);
  EXPECT_EQ(round_->scatter_within(), 1.0);
  EXPECT_NEAR(round_->scale_test().offset, 0.0, 1e-9);
  EXPECT_NEAR(round_->scale_test().p_value, 1.0, 1e-6);
  const auto steps = round_->steps_of_shots();
  ASSERT_EQ(steps.size(), 2U);
  for (const auto& step : steps) EXPECT_LT(step.move.norm(), 1e-9);
  const ShotAgreement agreement = round_->agreement(steps);
  EXPECT_EQ(agreement.dof, 2);
  EXPECT_NEAR(agreement.chi2, 0.0, 1e-9);
  // From so few blocks the parts' covariance is unusable: no misfit is stated.
  EXPECT_EQ(round_->misfit().dof, 0.0);
  EXPECT_LT((round_->cell_covariance() - cell_covariance_).norm(), 1e-9 * cell_covariance_.norm());
}

TEST_F(RoundOfTheCube, MonteCarloErrorsCountWhatTheWeightsLearnedToo) {
  take();
  const Eigen::MatrixXd& inverse = round_->step().inverse;
  const Eigen::MatrixXd paths =
      inverse * round_->look().covariance.topLeftCorner(5, 5) * inverse.transpose();
  const auto stated = std::find_if(
      round_->step().causes.begin(), round_->step().causes.end(),
      [](const ScatteringEquation::Step::Cause& c) { return c.name == "Monte Carlo"; });
  ASSERT_NE(stated, round_->step().causes.end());
  EXPECT_NEAR(stated->covariance(1, 1) / paths(1, 1), variance_by_learning(round_->blocks()), 1e-6);
}

// The equation is linear: an image that departs along a derivative is met by exactly that step.
TEST_F(RoundOfTheCube, AStepMeetsADepartureAlongTheDerivatives) {
  constexpr double kLogSigmaS = 0.01, kSigmaA = 2e-4;
  system_.l = image_.l + kLogSigmaS * image_.per_log_sigma_s + kSigmaA * image_.per_sigma_a;
  round_.emplace(TransportShots{system_, parts_}, ScalePrior{}, kRoundPoint, pilots(), 1.0);
  take();
  ASSERT_EQ(round_->step().move.size(), 2);
  EXPECT_NEAR(round_->step().move[0], kLogSigmaS, 1e-9);
  EXPECT_NEAR(round_->step().move[1], kSigmaA, 1e-10);
  EXPECT_NEAR(round_->step().to.sigma_s_per_mm, 0.9 * std::exp(kLogSigmaS), 1e-9);
  EXPECT_NEAR(round_->step().to.sigma_a_per_mm, 0.01 + kSigmaA, 1e-10);
}

}  // namespace
}  // namespace scattermeter
