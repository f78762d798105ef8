// The medium whose simulated image is the observed one.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// The current point of the search. Domain: sigma_s > 0, sigma_a >= 0, scale > 0.
struct ScatteringPoint {
  double sigma_s_per_mm = 0;
  double sigma_a_per_mm = 0;
  double scale = 1;  // measured over predicted
};

// Z^T W (y - scale * m(point)) = 0, to be solved with noisy m. A least-squares fit would take
// weights and derivatives from the same noisy paths as m, and be biased by it; here Z and W are
// those of a pilot simulation that shares no path with m, so that the equation is linear in m, and
// its root without bias to first order (PHYSICS: an estimating equation). W is the inverse of the
// full covariance of the rows: their noise, the pilot's Monte Carlo variance, and the priors of the
// nuisances.
class ScatteringEquation {
 public:
  // pilot: image at `at`, rows as the system's (l for the shots' real lights: W/mm^2 at scale 1).
  // monte_carlo: relative to the pilot's variance, the one expected of the m to come and of what
  // else the shots err by beyond their noise. correlated (rows x any number, or empty): columns of
  // unit deviation, how that is alike from row to row; for the weights alone.
  // Precondition: as many rows each (std::invalid_argument).
  ScatteringEquation(const DenseSystem& system, const ScalePrior& scale,
                     const ScatteringImage& pilot, const ScatteringPoint& at,
                     double monte_carlo = 1.0, const Eigen::MatrixXd& correlated = {});

  // Unknowns x rows: Z^T W. Unknowns: log sigma_s, sigma_a, and log scale where it is free. A scale
  // with a prior is a nuisance: noisy derivatives leave its own equation no definite sign.
  const Eigen::MatrixXd& projection() const { return projection_; }

  struct Step {
    ScatteringPoint to;
    // Covariance of (log sigma_s, sigma_a[, log scale]) by cause: "noise", "Monte Carlo", "scatter"
    // (of the shots, beyond their noise), "scale", the nuisances' groups.
    struct Cause {
      std::string name;
      Eigen::MatrixXd covariance;
    };
    std::vector<Cause> causes;
    Eigen::MatrixXd covariance;  // the sum
    // Largest relative change of the image that an unknown's move makes (of sigma_s: its own, where
    // that is larger), uncut.
    double change = 0;
    Eigen::VectorXd size;     // of that change, relative, per unit of each unknown
    Eigen::VectorXd move;     // uncut, in the unknowns
    Eigen::MatrixXd inverse;  // from projection() * l to the move
    // Moves by one deviation of each common cause: a column for every nuisance, and one for a scale
    // that has a prior.
    Eigen::MatrixXd common_causes;
  };
  // One Newton step from `at`, m there, and the covariance of projection() * m at scale 1.
  // A step is cut to a change of 0.4 and at sigma_a = 0. scatter >= 1: over the Monte
  // Carlo variance of the rows, how much they err beyond their noise (core/fit/excess_scatter.h).
  Step step(const ScatteringImage& m, const Eigen::MatrixXd& projected_covariance,
            const ScatteringPoint& at, double scatter = 1.0) const;

  // Measured less predicted l at a step's end, m linear on the way from `at`; nuisances nominal.
  Eigen::VectorXd residual(const ScatteringImage& m, const ScatteringPoint& at,
                           const ScatteringPoint& to) const;
  // The same less what the nuisances, at their most probable, make of it.
  Eigen::VectorXd without_nuisances(const Eigen::VectorXd& residual) const;
  // Of noise and Monte Carlo, as weighed with.
  const Eigen::VectorXd& row_variance() const { return row_variance_; }
  // Columns times their standard deviations, last that of a scale with a prior; free ones at a size
  // far beyond what the rows leave open.
  const Eigen::MatrixXd& nuisances() const { return nuisances_; }
  // Row vector that estimates, from measured less predicted l, the offset of log scale from its
  // stated value: 1 for scale * pilot.l, 0 for what the unknowns can do, of the least variance.
  // Empty where the scale is free, or where the unknowns can imitate it.
  const Eigen::RowVectorXd& scale_form() const { return scale_form_; }
  struct ScaleTest {
    double offset = 0;   // of log scale: best less stated
    double std = 0;      // of that where the statement is true, prior included
    double p_value = 1;  // of at least this much
  };
  // form_variance: of scale_form() times the predicted l, by its paths. Nuisances take part within
  // their priors; light that is even over the object makes the test impossible: p is then 1.
  ScaleTest scale_test(const Eigen::VectorXd& residual, double form_variance, double scatter) const;
  // What a log scale off by `offset`, sign unknown, adds to a step.
  void widen_by_scale(double offset, Step& step) const;
  // The most probable log of a scale with a prior; else 0.
  double settled_log_scale(const Eigen::VectorXd& residual) const;
  // Derivatives of scale * m by the unknowns, rows x unknowns.
  static Eigen::MatrixXd jacobian(const ScatteringImage& m, const ScatteringPoint& at,
                                  bool scale_moves);

 private:
  Eigen::VectorXd solve_covariance(const Eigen::VectorXd& rows) const;
  const DenseSystem& system_;
  ScalePrior scale_;
  Eigen::VectorXd row_variance_;     // noise and Monte Carlo
  std::vector<std::string> causes_;  // of the nuisances
  Eigen::MatrixXd nuisances_;        // columns times their standard deviations
  Eigen::MatrixXd columns_;          // those and the correlated ones
  Eigen::MatrixXd capacitance_;      // of Woodbury's identity, inverted
  Eigen::MatrixXd projection_;
  Eigen::VectorXd relative_size_;  // of the image's change with each unknown
  Eigen::VectorXd per_log_scale_;  // scale * pilot.l
  Eigen::RowVectorXd scale_form_;
};

}  // namespace scattermeter
