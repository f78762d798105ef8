#include "core/fit/dipole_misfit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"
#include "core/base/log_spline.h"
#include "core/diffusion/dipole_curve.h"
#include "core/fit/marginal_information.h"
#include "core/fit/reflectance_pilot.h"

namespace scattermeter {

void DipoleMisfitOptions::Check() const {
  if (!(scale.relative_std >= 0.0)) throw std::invalid_argument("DipoleMisfitOptions.scale");
  if (!(sought_departure > 0.0)) {
    throw std::invalid_argument("DipoleMisfitOptions.sought_departure");
  }
}

namespace {

// Departures of log R that the test looks for: splines, of a normal prior.
struct Departures {
  Eigen::MatrixXd on_knots;   // of a parameter of unit prior
  Eigen::MatrixXd draws;      // of the spline's parameters, for a unit prior
  Eigen::MatrixXd at_breaks;  // of the spline's parameters
};

Departures sought_departures(const DistanceKnots& knots, double sigma_t_per_mm, double size) {
  // Breaks: two an octave of d^2 + z_r^2.
  const Eigen::VectorXd t = log_squared_depth(knots, 1.0 / sigma_t_per_mm);
  const int intervals =
      std::max(2, static_cast<int>(std::ceil((t[t.size() - 1] - t[0]) * 2.0 / std::numbers::ln2)));
  std::vector<double> breaks;
  for (int i = 0; i <= intervals; ++i) {
    breaks.push_back(t[0] + (t[t.size() - 1] - t[0]) * i / intervals);
  }
  const LogSpline spline(breaks);
  const Eigen::Index n = spline.size();
  Eigen::MatrixXd basis(t.size(), n);
  for (Eigen::Index i = 0; i < t.size(); ++i) basis.row(i) = spline.row(t[i]);
  // delta at the breaks and its second differences, each of the given size.
  Eigen::MatrixXd prior(2 * intervals, n);
  for (int i = 0; i <= intervals; ++i) {
    prior.row(i) = spline.row(breaks[static_cast<std::size_t>(i)]);
  }
  for (int i = 1; i < intervals; ++i) {
    prior.row(intervals + i) = prior.row(i - 1) - 2.0 * prior.row(i) + prior.row(i + 1);
  }
  const Eigen::MatrixXd at_breaks = prior.topRows(intervals + 1);
  // The spline has two parameters more than breaks: slopes at the ends, which the prior does not
  // constrain; they are left at what the natural size of theta allows.
  prior.conservativeResize(prior.rows() + n, n);
  prior.bottomRows(n).setIdentity();
  const Eigen::MatrixXd draws =
      size * HouseholderSolver(prior).r().triangularView<Eigen::Upper>().solve(
                 Eigen::MatrixXd::Identity(n, n));
  return {basis * draws, draws, at_breaks};
}

}  // namespace

DipoleMisfit dipole_misfit(const RecoveredReflectance& recovered,
                           const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                           const Medium& medium, double scale, const DipoleMisfitOptions& options) {
  options.Check();
  DipoleMisfit out;
  const double sigma_t = medium.sigma_s_prime_per_mm + medium.sigma_a_per_mm;
  if (!(medium.sigma_s_prime_per_mm > 0.0) || !(medium.sigma_a_per_mm >= 0.0) ||
      !std::isfinite(sigma_t) || !(scale > 0.0) || !std::isfinite(scale)) {
    out.reasons.push_back("there is no dipole to compare with");
    return out;
  }
  if (recovered.whitened.size() == 0 || !recovered.sqrt_information.allFinite() ||
      !recovered.whitened.allFinite()) {
    out.reasons.push_back("no light reaches the object in these shots");
    return out;
  }
  const MarginalInformation image =
      marginal_information(recovered, nuisances, knots.size(), NuisanceUse::kAll);
  const DipoleCurve dipole = dipole_curve(knots, std::log(sigma_t), medium.sigma_a_per_mm / sigma_t,
                                          medium.eta_int_over_ext);

  const Departures sought = sought_departures(knots, sigma_t, options.sought_departure);
  // The image's rows, and the scale's prior below them.
  const bool scale_moves = options.scale.relative_std > 0.0;
  const Eigen::Index rows = image.data.size();
  const double inverse_std = scale_moves ? 1.0 / options.scale.relative_std : 0.0;
  Eigen::VectorXd residual(rows + 1);
  residual << image.data - image.kernel * (scale * dipole.r), -inverse_std * std::log(scale);
  Eigen::MatrixXd own = Eigen::MatrixXd::Zero(rows + 1, scale_moves ? 3 : 2);
  own.col(0).head(rows) = image.kernel * (scale * dipole.d_u);
  own.col(1).head(rows) = image.kernel * (scale * dipole.d_q);
  if (scale_moves) {
    own.col(2).head(rows) = image.kernel * (scale * dipole.r);
    own(rows, 2) = inverse_std;
  }
  Eigen::MatrixXd freed = Eigen::MatrixXd::Zero(rows + 1, sought.on_knots.cols());
  freed.topRows(rows) = image.kernel * ((scale * dipole.r).asDiagonal() * sought.on_knots);
  if (!residual.allFinite() || !own.allFinite() || !freed.allFinite()) {
    out.reasons.push_back("there is no dipole to compare with");
    return out;
  }
  own.colwise().normalize();
  const PivotedSolver own_qr(own);
  const Eigen::Index rank = own_qr.rank();
  const Eigen::VectorXd rest = own_qr.rotate(residual).tail(rows + 1 - rank);
  const ThinSvd svd = thin_svd(own_qr.rotate_columns(freed).bottomRows(rows + 1 - rank));
  const Eigen::Index dof = (svd.values.array() > 1.0).count();
  if (dof == 0) {
    out.reasons.push_back("these shots would not show a departure from the dipole");
    return out;
  }
  const Eigen::VectorXd along = svd.u.leftCols(dof).transpose() * rest;
  const double left = rest.squaredNorm() + recovered.floor_chi2 - along.squaredNorm();
  const double spare =
      static_cast<double>(recovered.rows) - static_cast<double>(dof) - static_cast<double>(rank);
  const double excess = spare > 0.0 ? std::max(1.0, left / spare) : 1.0;
  out.chi2_drop = along.squaredNorm() / excess;
  out.dof = static_cast<int>(dof);
  out.p_value = chi_square_tail(out.chi2_drop, static_cast<double>(dof));
  const Eigen::VectorXd theta =
      sought.draws * (svd.v.leftCols(dof) * along.cwiseQuotient(svd.values.head(dof)));
  const Eigen::VectorXd departure = sought.at_breaks * theta;
  out.log_departure = std::sqrt(departure.squaredNorm() / static_cast<double>(departure.size()));
  return out;
}

}  // namespace scattermeter
