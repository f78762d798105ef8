// One point of the search for a medium by transport.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/estimation/channel_simulation.h"
#include "core/estimation/transport_verdict.h"
#include "core/fit/lack_of_fit.h"
#include "core/fit/linear_shot.h"
#include "core/fit/scattering_equation.h"
#include "core/fit/shot_agreement.h"
#include "core/fit/shot_parts.h"

namespace scattermeter {

// What the search works on; all must outlive its rounds.
struct TransportShots {
  const DenseSystem& system;
  const ShotParts& parts;
  const ChannelSimulation& simulation;
};

// Estimating equations for all shots and for each alone, and their solution by paths drawn for
// them.
class TransportRound {
 public:
  // Shots of fewer rows have no estimate of their own.
  static constexpr Eigen::Index kLeastRows = 20;

  // pilot: smooth, not of the paths to come. expected: Monte Carlo variance of the rows to come and
  // of other errors of the shots, over the pilot's; cells: the covariance of the cells' relative
  // light that belongs to it. Both serve the weights only.
  TransportRound(const TransportShots& shots, const ScalePrior& scale, const ScatteringPoint& at,
                 const ScatteringImage& pilot, double expected, const Eigen::MatrixXd& cells);
  // The equations refer to other members.
  TransportRound(const TransportRound&) = delete;
  TransportRound& operator=(const TransportRound&) = delete;

  // Of the joint estimate, of each shot's own, of the scale (where it is stated), and of the light
  // of the cells.
  Eigen::MatrixXd projection() const;
  // A draw for that projection, traced at this point. Everything below is from the last one.
  void take(const ChannelSimulation::Draw& draw);

  const ScatteringPoint& at() const { return at_; }
  const ScatteringEquation& equation() const { return joint_; }
  const ScatteringImage& image() const { return image_; }
  const ScatteringImage& pilot() const { return pilot_; }
  int blocks() const { return blocks_; }
  Eigen::MatrixXd cell_covariance() const;
  // To the joint estimate, scatter included.
  const ScatteringEquation::Step& step() const { return step_; }
  // Measured less predicted l at its end.
  Eigen::VectorXd residual() const { return joint_.residual(image_, at_, step_.to); }
  // Over the Monte Carlo variance, what shots err by beyond their noise: within their parts, and in
  // all (parts that are as improbable as 1 in 100 widen it by Birge's ratio).
  double scatter_within() const { return scatter_within_; }
  double scatter() const { return scatter_; }
  // Whether the image contradicts the stated scale.
  ScatteringEquation::ScaleTest scale_test() const;

  // Shots with an estimate of their own (indices), and the steps to it; none for a single shot.
  std::vector<std::size_t> shots() const;
  std::vector<ScatteringEquation::Step> steps_of_shots() const;
  std::size_t rows_of_shot(std::size_t i) const {
    return static_cast<std::size_t>(singles_[i].system.l.size());
  }
  // Between those estimates, from what they share.
  ShotAgreement agreement(const std::vector<ScatteringEquation::Step>& steps) const;
  // Of the light of the shots' parts, with free coefficients. Nothing (dof 0) from fewer than
  // kLeastBlocks.
  const LackOfFit& misfit() const { return misfit_; }

 private:
  struct Single {
    std::size_t shot;
    Eigen::Index first;  // row
    DenseSystem system;
    std::optional<ScatteringEquation> equation;
  };
  Eigen::Index unknowns() const { return joint_.projection().rows(); }
  double scatter_of_cells(const Eigen::VectorXd& rest) const;
  LackOfFit misfit_of(const Eigen::VectorXd& rest) const;

  TransportShots shots_;
  ScatteringPoint at_;
  ScatteringImage pilot_;
  Eigen::MatrixXd correlated_;  // errors that rows have in common
  ScatteringEquation joint_;
  std::vector<Single> singles_;
  ScatteringImage image_;
  Eigen::MatrixXd covariance_;  // of projection() * image
  double scatter_within_ = 1;
  double scatter_ = 1;
  LackOfFit misfit_;
  ScatteringEquation::Step step_;
  int blocks_ = 0;
};

}  // namespace scattermeter
