#include "core/fit/score_tests.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"
#include "core/diffusion/dipole_curve.h"
#include "core/fit/marginal_information.h"

namespace scattermeter {
namespace {

struct TestedImage {
  MarginalInformation information;
  Eigen::VectorXd residual;
  double length;
};

// fitted: columns of the parameters that the fit moved. curve: change of scale * R per unit of the
// offset. already: offset already fitted; stated_variance: of the stated value.
ScoreTest score_test(const TestedImage& image, const Eigen::MatrixXd& fitted,
                     const Eigen::VectorXd& curve, double already, double stated_variance,
                     double noise) {
  ScoreTest out;
  const Eigen::VectorXd change = image.information.kernel * curve;
  const PivotedSolver qr(fitted);
  Eigen::VectorXd own = qr.rotate(change);
  const Eigen::VectorXd rest = qr.rotate(image.residual);
  own.head(qr.rank()).setZero();
  const double information = own.squaredNorm();
  // Only rounding remains of it: the image does not determine it.
  if (!(information > 1e-16 * change.squaredNorm()) || !std::isfinite(information)) return out;
  out.offset = already + own.dot(rest) / information;
  const double variance = noise / information + stated_variance;
  const double chi2 = out.offset * out.offset / variance;
  if (!std::isfinite(chi2)) return out;
  out.p_value = chi_square_tail(chi2, 1.0);
  out.image_relative = std::abs(out.offset) * change.norm() / image.length;
  out.explained_relative = std::abs(own.dot(rest)) / std::sqrt(information) / image.length;
  return out;
}

}  // namespace

ScoreTests score_tests(const RecoveredReflectance& recovered,
                       const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                       const DipoleSolver::Point& optimum, double eta_int_over_ext,
                       const ScalePrior& scale, double noise) {
  const DipoleCurve curve = dipole_curve(knots, optimum.u, optimum.q, eta_int_over_ext);
  const double s = std::exp(optimum.log_s);
  TestedImage image{
      marginal_information(recovered, nuisances, knots.size(), NuisanceUse::kAll), {}, 0.0};
  const Eigen::VectorXd predicted = image.information.kernel * (s * curve.r);
  image.residual = image.information.data - predicted;
  image.length = std::max(image.information.data.norm(), 1e-300);
  const bool free = scale.is_free();
  Eigen::MatrixXd fitted(predicted.size(), 3);
  fitted.col(0) = image.information.kernel * (s * curve.d_u);
  fitted.col(1) = image.information.kernel * (s * curve.d_q);
  fitted.col(2) = predicted;
  fitted.colwise().normalize();
  ScoreTests out;
  if (!fitted.allFinite() || !image.residual.allFinite()) return out;
  if (!free) {
    out.scale = score_test(image, fitted.leftCols(2), s * curve.r, optimum.log_s,
                           scale.relative_std * scale.relative_std, noise);
    out.scale.per_offset = recovered.sqrt_information.leftCols(knots.size()) * (s * curve.r);
  }
  constexpr double kStep = 1e-3;
  const Eigen::VectorXd by_eta =
      s *
      (dipole_curve(knots, optimum.u, optimum.q, eta_int_over_ext + kStep).r -
       dipole_curve(knots, optimum.u, optimum.q, eta_int_over_ext - kStep).r) /
      (2.0 * kStep);
  out.eta =
      score_test(image, fitted.leftCols(scale.relative_std > 0.0 ? 3 : 2), by_eta, 0.0, 0.0, noise);
  out.eta.per_offset = recovered.sqrt_information.leftCols(knots.size()) * by_eta;
  return out;
}

std::string contradiction_sentence(const ScoreTest& test, const std::string& quantity) {
  constexpr double kMost = 1.0;
  if (!(std::abs(test.offset) < kMost)) {
    return fmt::format(
        "the shots contradict the {} that the rig states, and no other value explains them",
        quantity);
  }
  return fmt::format(
      "the shots contradict the {} that the rig states: the best fit differs from it by {:.3g}",
      quantity, test.offset);
}

}  // namespace scattermeter
