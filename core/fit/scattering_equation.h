// The estimating equation for the medium whose simulated image matches the observed one.
#pragma once

#include <array>
#include <cstddef>
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

// What the weights of the rows are learned from.
struct EquationPilot {
  ScatteringImage image;  // smooth, at the point of the equation
  // The correlation between rows of errors to be expected; used in the weights only.
  CorrelatedErrors errors = {};
  // Rows x any: smooth images of which, with the derivatives of `image`, the true derivatives are
  // sums, about. expected: (derivatives of `image`, further) x unknowns, the coefficients of that
  // sum before any path is seen.
  Eigen::MatrixXd further = {};
  Eigen::MatrixXd expected = {};
};

// By half of the paths, which share none.
using PathHalves = std::array<ScatteringImage, 2>;

// Z^T W (y - scale * m(point)) = 0, to be solved with noisy m. A least-squares fit would take
// weights and derivatives from the same noisy paths as m, which would bias it, by the more the less
// of Z the nuisances leave; here the image of one half of the paths is weighed by Z and W learned
// from the other, so the equation is linear in m and its root unbiased to first order (PHYSICS: an
// estimating equation; Chernozhukov et al. 2018: cross-fitting). Its deviations are unbiased for
// the same reason: W favours what its own half's paths happen to know well. W is the inverse of the
// full covariance of the rows: their noise, the pilot's Monte Carlo variance, and the priors of the
// nuisances. Z is the regression, with these weights, of the derivatives that the paths of the
// other half show on the instruments: the pilot's derivatives and its further images (two-stage
// least squares; Hansen 1982), with a prior, as few paths tell little. The pilot's derivatives
// alone have detail that paths do not show; weights of a cube's shots with them left 4 to 20 times
// the deviation.
class ScatteringEquation {
 public:
  // pilots: images at `at`, with the system's rows (l for the shots' real lights: W/mm^2 at scale
  // 1), learned from either half of the paths; or one, from paths of its own. monte_carlo: expected
  // variance of the m to come, and of the shots' errors beyond their noise, relative to the pilot's
  // variance. Precondition: equal numbers of rows, one or two pilots (std::invalid_argument).
  ScatteringEquation(const DenseSystem& system, const ScalePrior& scale,
                     std::vector<EquationPilot> pilots, const ScatteringPoint& at,
                     double monte_carlo = 1.0);
  ScatteringEquation(const DenseSystem& system, const ScalePrior& scale,
                     const ScatteringImage& pilot, const ScatteringPoint& at)
      : ScatteringEquation(system, scale, {{pilot, {}}}, at) {}

  // Log sigma_s, sigma_a, and log scale where it is free. A scale with a prior is a nuisance, since
  // noisy derivatives leave the sign of an equation of its own undetermined.
  Eigen::Index unknowns() const { return weights_.front().relative_size.size(); }
  // Instruments x rows: these, transposed, times W, for the image of a half (0 or 1).
  const Eigen::MatrixXd& projection(std::size_t half) const { return of(half).projection; }

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
    Eigen::MatrixXd inverse;  // from the mean of projection(half) * l(half) to the move
    // The covariance if W is right: the inverse of what the paths' derivatives tell.
    Eigen::MatrixXd promised;
    // Moves caused by one deviation of each common cause: a column for every nuisance
    // (DenseSystem::beyond_column included), and one for a scale with a prior.
    Eigen::MatrixXd common_causes;
  };
  // One Newton step from `at`, given m there and the covariance of the mean of projection(half) *
  // m(half) at scale 1. A step is cut to a change of 0.4 and ends at sigma_a = 0 at the latest.
  // scatter >= 1: the rows' error variance beyond their noise over their Monte Carlo variance
  // (core/fit/excess_scatter.h).
  Step step(const PathHalves& m, const Eigen::MatrixXd& projected_covariance,
            const ScatteringPoint& at, double scatter = 1.0) const;

  // Measured minus predicted l at a step's end, m extrapolated linearly from `at`; nuisances
  // nominal.
  Eigen::VectorXd residual(const ScatteringImage& m, const ScatteringPoint& at,
                           const ScatteringPoint& to) const;
  // The same minus the effect of the nuisances at their most probable values.
  Eigen::VectorXd without_nuisances(const Eigen::VectorXd& residual) const;
  // Variance of noise and Monte Carlo as used in the weights.
  const Eigen::VectorXd& row_variance() const { return weights_.front().row_variance; }
  // Columns times their standard deviations, the last for a scale with a prior; free ones at a size
  // far beyond what the rows leave undetermined.
  const Eigen::MatrixXd& nuisances() const { return weights_.front().nuisances; }
  // Row vector that estimates, from the image of a half, the offset of log scale from its stated
  // value from measured minus predicted l: 1 on scale * pilot.l, 0 on changes by the unknowns, of
  // minimum variance. Empty if the scale is free or if the unknowns can imitate it.
  const Eigen::RowVectorXd& scale_form(std::size_t half) const { return of(half).scale_form; }
  struct ScaleTest {
    double offset = 0;   // of log scale: best minus stated
    double std = 0;      // of the offset if the stated scale is true, prior included
    double p_value = 1;  // of at least this offset
  };
  // residuals: residual() with the image of either half. form_variance: Monte Carlo variance of the
  // mean of scale_form(half) times the predicted l. Nuisances vary within their priors; under
  // uniform light the test is impossible and p is 1.
  ScaleTest scale_test(const std::array<Eigen::VectorXd, 2>& residuals, double form_variance,
                       double scatter) const;
  // Adds to a step the covariance of an error of log scale by `offset`, of unknown sign.
  void widen_by_scale(double offset, Step& step) const;
  // The most probable log scale if it has a prior; else 0.
  double settled_log_scale(const Eigen::VectorXd& residual) const;
  // Derivatives of scale * m by the unknowns, rows x unknowns.
  static Eigen::MatrixXd jacobian(const ScatteringImage& m, const ScatteringPoint& at,
                                  bool scale_moves);

 private:
  // Learned from one pilot.
  struct Weights {
    Weights(const DenseSystem& system, const ScalePrior& scale, EquationPilot pilot,
            const ScatteringPoint& at, double monte_carlo);
    // Nuisances and correlated errors, as columns: transposed times rows, and times coefficients.
    Eigen::MatrixXd in_columns(const Eigen::MatrixXd& rows) const;
    Eigen::MatrixXd in_rows(const Eigen::MatrixXd& columns) const;
    Eigen::MatrixXd solve_covariance(const Eigen::MatrixXd& rows) const;
    // Unknowns x instruments: the coefficients of Z for the image of the other half, from the
    // projected derivatives of the half that these weights are for (`seen`) and of the other.
    Eigen::MatrixXd mixing(const Eigen::MatrixXd& seen, const Eigen::MatrixXd& by_other) const;
    Eigen::VectorXd row_variance;  // noise and Monte Carlo
    Eigen::MatrixXd nuisances;     // columns times their standard deviations
    CorrelatedErrors errors;
    Eigen::MatrixXd capacitance;  // of Woodbury's identity, inverted
    Eigen::MatrixXd projection;
    Eigen::MatrixXd gram;            // projection times instruments
    Eigen::MatrixXd of_nuisances;    // projection times nuisances
    Eigen::MatrixXd expected;        // coefficients of Z
    Eigen::MatrixXd inverse_spread;  // of these, squared
    Eigen::VectorXd relative_size;   // of the image's change with each unknown
    Eigen::VectorXd per_log_scale;   // scale * image.l
    Eigen::RowVectorXd scale_form;
  };
  // Those for the image of a half.
  const Weights& of(std::size_t half) const {
    return weights_.size() == 1 ? weights_.front() : weights_[1 - half];
  }
  // The mean of `f(weights, half)` over the halves.
  template <class F>
  Eigen::MatrixXd mean(const F& f) const {
    return 0.5 * (f(of(0), 0) + f(of(1), 1));
  }
  const DenseSystem& system_;
  ScalePrior scale_;
  std::vector<std::string> causes_;  // of the nuisances
  std::vector<Weights> weights_;
};

}  // namespace scattermeter
