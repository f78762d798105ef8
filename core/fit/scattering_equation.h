// The estimating equation for the medium whose simulated image matches the observed one.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

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

// Errors common to groups of rows. of_row * root: rows x columns of unit deviation; the errors of
// the groups are root times independent unit errors, and those of the rows follow from their
// group's. Both empty: none.
struct CorrelatedErrors {
  Eigen::SparseMatrix<double, Eigen::RowMajor> of_row = {};  // rows x groups
  Eigen::MatrixXd root = {};                                 // groups x columns
};

// Z^T W (y - scale * m(point)) = 0, to be solved with noisy m. A least-squares fit would take
// weights and derivatives from the same noisy paths as m, which would bias it; here Z and W come
// from a pilot simulation that shares no path with m, so the equation is linear in m and its root
// unbiased to first order (PHYSICS: an estimating equation). W is the inverse of the full
// covariance of the rows: their noise, the pilot's Monte Carlo variance, and the priors of the
// nuisances.
class ScatteringEquation {
 public:
  // pilot: image at `at`, with the system's rows (l for the shots' real lights: W/mm^2 at scale 1).
  // monte_carlo: expected variance of the m to come, and of the shots' errors beyond their noise,
  // relative to the pilot's variance. correlated: the correlation of these errors between rows;
  // used in the weights only. Precondition: equal numbers of rows (std::invalid_argument).
  ScatteringEquation(const DenseSystem& system, const ScalePrior& scale,
                     const ScatteringImage& pilot, const ScatteringPoint& at,
                     double monte_carlo = 1.0, CorrelatedErrors correlated = {});

  // Unknowns x rows: Z^T W. Unknowns: log sigma_s, sigma_a, and log scale where it is free. A scale
  // with a prior is a nuisance, since noisy derivatives leave the sign of an equation of its own
  // undetermined.
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
    // Largest relative change of the image by what one unknown takes (sigma_s: its own relative
    // change, if that is larger).
    double change = 0;
    Eigen::VectorXd size;  // relative change of the image per unit of each unknown
    Eigen::VectorXd move;  // in the unknowns, to the root
    // The same, or where the root has a negative sigma_a, to the most probable point at 0: the
    // other unknowns follow by their covariance with it. Before the step is cut.
    Eigen::VectorXd taken;
    Eigen::MatrixXd inverse;  // from projection() * l to the move
    // Moves caused by one deviation of each common cause: a column for every nuisance, and one for
    // a scale with a prior.
    Eigen::MatrixXd common_causes;
  };
  // One Newton step from `at`, given m there and the covariance of projection() * m at scale 1. A
  // step is cut to a change of 0.4 and ends at sigma_a = 0 at the latest. scatter >= 1: the rows'
  // error variance beyond their noise over their Monte Carlo variance (core/fit/excess_scatter.h).
  Step step(const ScatteringImage& m, const Eigen::MatrixXd& projected_covariance,
            const ScatteringPoint& at, double scatter = 1.0) const;

  // Measured minus predicted l at a step's end, m extrapolated linearly from `at`; nuisances
  // nominal.
  Eigen::VectorXd residual(const ScatteringImage& m, const ScatteringPoint& at,
                           const ScatteringPoint& to) const;
  // The same minus the effect of the nuisances at their most probable values.
  Eigen::VectorXd without_nuisances(const Eigen::VectorXd& residual) const;
  // Variance of noise and Monte Carlo as used in the weights.
  const Eigen::VectorXd& row_variance() const { return row_variance_; }
  // Columns times their standard deviations, the last for a scale with a prior; free ones at a size
  // far beyond what the rows leave undetermined.
  const Eigen::MatrixXd& nuisances() const { return nuisances_; }
  // Row vector that estimates the offset of log scale from its stated value from measured minus
  // predicted l: 1 on scale * pilot.l, 0 on changes by the unknowns, of minimum variance. Empty if
  // the scale is free or if the unknowns can imitate it.
  const Eigen::RowVectorXd& scale_form() const { return scale_form_; }
  struct ScaleTest {
    double offset = 0;   // of log scale: best minus stated
    double std = 0;      // of the offset if the stated scale is true, prior included
    double p_value = 1;  // of at least this offset
  };
  // form_variance: Monte Carlo variance of scale_form() times the predicted l. Nuisances vary
  // within their priors; under uniform light the test is impossible and p is 1.
  ScaleTest scale_test(const Eigen::VectorXd& residual, double form_variance, double scatter) const;
  // Adds to a step the covariance of an error of log scale by `offset`, of unknown sign.
  void widen_by_scale(double offset, Step& step) const;
  // The most probable log scale if it has a prior; else 0.
  double settled_log_scale(const Eigen::VectorXd& residual) const;
  // Derivatives of scale * m by the unknowns, rows x unknowns.
  static Eigen::MatrixXd jacobian(const ScatteringImage& m, const ScatteringPoint& at,
                                  bool scale_moves);

 private:
  // Nuisances and correlated errors, as columns: transposed times rows, and times coefficients.
  Eigen::MatrixXd in_columns(const Eigen::MatrixXd& rows) const;
  Eigen::VectorXd in_rows(const Eigen::VectorXd& columns) const;
  Eigen::VectorXd solve_covariance(const Eigen::VectorXd& rows) const;
  const DenseSystem& system_;
  ScalePrior scale_;
  Eigen::VectorXd row_variance_;     // noise and Monte Carlo
  std::vector<std::string> causes_;  // of the nuisances
  Eigen::MatrixXd nuisances_;        // columns times their standard deviations
  CorrelatedErrors correlated_;
  Eigen::MatrixXd capacitance_;  // of Woodbury's identity, inverted
  Eigen::MatrixXd projection_;
  Eigen::VectorXd relative_size_;  // of the image's change with each unknown
  Eigen::VectorXd per_log_scale_;  // scale * pilot.l
  Eigen::RowVectorXd scale_form_;
};

}  // namespace scattermeter
