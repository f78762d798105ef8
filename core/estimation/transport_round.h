// One point of the search for a medium by transport.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/agreement/shot_agreement.h"
#include "core/estimation/channel_simulation.h"
#include "core/estimation/transport_verdict.h"
#include "core/fit/estimate.h"
#include "core/fit/lack_of_fit.h"
#include "core/fit/linear_shot.h"
#include "core/fit/prior_pulls.h"
#include "core/fit/scattering_equation.h"
#include "core/fit/shot_parts.h"

namespace scattermeter {

// The data of the search; all must outlive its rounds.
struct TransportShots {
  const DenseSystem& system;
  const ShotParts& parts;
};

// Estimating equations for all shots and for each shot alone, and their solution with newly drawn
// paths.
class TransportRound {
 public:
  // Shots with fewer rows have no estimate of their own.
  static constexpr Eigen::Index kLeastRows = 20;

  struct Pilot {
    ScatteringImage image;  // smooth
    // Covariance of the cells' relative light that corresponds to `expected`.
    Eigen::MatrixXd cells;
  };
  // pilots: each from one half of the paths to come (ScatteringEquation). expected: expected
  // variance of the rows, by Monte Carlo and by other errors of the shots, over the pilots'; used
  // in the weights only.
  TransportRound(const TransportShots& shots, const ScalePrior& scale, const ScatteringPoint& at,
                 const std::array<Pilot, 2>& pilots, double expected);
  // The equations refer to other members.
  TransportRound(const TransportRound&) = delete;
  TransportRound& operator=(const TransportRound&) = delete;

  // The projections for the joint estimate, for each shot's own, for the scale (if stated), and for
  // the light of the cells.
  ChannelSimulation::Projections projections() const;
  // Takes a look at this point with that projection. Everything below refers to the last one.
  void take(ChannelSimulation::Look look);

  const ScatteringPoint& at() const { return at_; }
  const ScatteringEquation& equation() const { return joint_; }
  const ScatteringImage& image() const { return look_.image; }
  // The mean of both.
  const ScatteringImage& pilot() const { return pilot_; }
  int blocks() const { return look_.blocks; }
  const ChannelSimulation::Look& look() const { return look_; }
  Eigen::MatrixXd cell_covariance() const { return of_cells(look_.covariance); }
  // Of projections() times an image, the light of the cells alone.
  Eigen::MatrixXd of_cells(const Eigen::MatrixXd& covariance) const;
  // The step to the joint estimate, scatter included.
  const ScatteringEquation::Step& step() const { return step_; }
  // Variance of log sigma_s that the weights promise, over that of the step.
  double efficiency() const { return step_.promised(0, 0) / step_.covariance(0, 0); }
  // Measured minus predicted l at its end.
  Eigen::VectorXd residual() const { return joint_.residual(image(), at_, step_.to); }
  // Error variance of the shots beyond their noise, over the Monte Carlo variance: within their
  // parts, and in total (a misfit of the parts less probable than 1 in 100 widens it by Birge's
  // ratio). The former is limited: rows may scatter by kMostRowScatter of the image beyond noise
  // and Monte Carlo, cells by kMostCellScatter, so that no residual excuses itself.
  static constexpr double kMostRowScatter = 0.03;
  static constexpr double kMostCellScatter = 0.005;
  // Root mean square of the rows' residual beyond noise and Monte Carlo, nuisances fitted, relative
  // to the image.
  double unexplained() const { return unexplained_; }
  double scatter_within() const { return scatter_within_; }
  double scatter() const { return scatter_; }
  // Of each row: noise and smooth Monte Carlo (smooth_path_variance), times `scatter`.
  Eigen::VectorXd row_variance(const std::vector<double>& area_mm2, double scatter) const;
  // Whether the image contradicts the stated scale.
  ScatteringEquation::ScaleTest scale_test() const;

  // Indices of the shots with an estimate of their own, and the steps to these; none for a single
  // shot.
  std::vector<std::size_t> shots() const;
  std::vector<ScatteringEquation::Step> steps_of_shots() const;
  std::size_t rows_of_shot(std::size_t i) const {
    return static_cast<std::size_t>(singles_[i].system.l.size());
  }
  // The agreement of those estimates, with their common errors taken into account.
  ShotAgreement agreement(const std::vector<ScatteringEquation::Step>& steps) const;
  // The misfit of the light of the shots' parts, with free coefficients. Empty (dof 0) for fewer
  // than kLeastBlocks blocks.
  const LackOfFit& misfit() const { return misfit_; }
  // On the rig's uncertain quantities, from the light of the parts; empty for fewer blocks.
  ModelJudgement judgement() const;
  // Precise, and either beyond doubt or with so many more blocks than the first precise ones that
  // still more would hardly tell.
  bool has_enough_paths() const;

 private:
  // further: of the pilots (EquationPilot), for all rows.
  TransportRound(const TransportShots& shots, const ScalePrior& scale, const ScatteringPoint& at,
                 const std::array<Pilot, 2>& pilots, const std::array<Eigen::MatrixXd, 2>& further,
                 double expected);
  struct Single {
    std::size_t shot;
    Eigen::Index first;  // row
    DenseSystem system;
    std::optional<ScatteringEquation> equation;
  };
  Eigen::Index unknowns() const { return joint_.unknowns(); }
  Eigen::Index instruments() const { return joint_.projection(0).rows(); }
  bool tests_scale() const;
  // Monte Carlo covariance of the projections of two estimates: 0 the joint one, then the single
  // shots'. With that of the weights and derivatives, which few paths teach badly.
  Eigen::MatrixXd covariance_between(Eigen::Index a, Eigen::Index b) const;
  Eigen::SparseMatrix<double> projection(std::size_t half) const;
  double scatter_of_cells(const Eigen::VectorXd& rest) const;
  // Covariance of the light of the parts by noise, Monte Carlo and scatter within them.
  Eigen::MatrixXd covariance_of_parts(const ShotParts::Sums& light) const;
  LackOfFit misfit_of(const Eigen::VectorXd& rest) const;

  TransportShots shots_;
  ScalePrior scale_;
  ScatteringPoint at_;
  ScatteringImage pilot_;
  ScatteringEquation joint_;
  std::vector<Single> singles_;
  ChannelSimulation::Look look_;
  double unexplained_ = 0;
  double scatter_within_ = 1;
  double scatter_ = 1;
  LackOfFit misfit_;
  ScatteringEquation::Step step_;
  int precise_blocks_ = 0;  // of the first precise look; 0: there was none
};

}  // namespace scattermeter
