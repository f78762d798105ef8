#include "core/fit/doubtful_input.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/dense_solve.h"
#include "core/diffusion/dipole_curve.h"
#include "core/fit/eliminated_nuisances.h"

namespace scattermeter {
namespace {

struct Image {
  EliminatedNuisances eliminated;
  Eigen::VectorXd residual;
  double length;
};

// `known`: parameters that the fit moved; `stated`: variance of what is stated.
Doubt doubt(const Image& image, const Eigen::MatrixXd& known, const Eigen::VectorXd& curve,
            double already, double stated, double noise) {
  Doubt out;
  const Eigen::VectorXd push = image.eliminated.kernel * curve;
  const PivotedSolver qr(known);
  Eigen::VectorXd own = qr.rotate(push);
  const Eigen::VectorXd rest = qr.rotate(image.residual);
  own.head(qr.rank()).setZero();
  const double information = own.squaredNorm();
  // Nothing but rounding is left of it: the image does not hold it.
  if (!(information > 1e-16 * push.squaredNorm()) || !std::isfinite(information)) return out;
  out.offset = already + own.dot(rest) / information;
  const double variance = noise / information + stated;
  const double chi2 = out.offset * out.offset / variance;
  if (!std::isfinite(chi2)) return out;
  out.p_value = chi_square_tail(chi2, 1.0);
  out.image_relative = std::abs(out.offset) * push.norm() / image.length;
  return out;
}

}  // namespace

Doubts doubtful_inputs(const RecoveredReflectance& recovered,
                       const std::vector<Nuisance>& nuisances, const DistanceKnots& knots,
                       const DipoleSolver::Point& optimum, double eta, const ScalePrior& scale,
                       double noise) {
  const DipoleCurve curve = dipole_curve(knots, optimum.u, optimum.q, eta);
  const double s = std::exp(optimum.log_s);
  Image image{eliminate_nuisances(recovered, nuisances, knots.size(), NuisanceUse::kAll), {}, 0.0};
  const Eigen::VectorXd predicted = image.eliminated.kernel * (s * curve.r);
  image.residual = image.eliminated.data - predicted;
  image.length = std::max(image.eliminated.data.norm(), 1e-300);
  const bool free = !std::isfinite(scale.relative_std);
  Eigen::MatrixXd known(predicted.size(), 3);
  known.col(0) = image.eliminated.kernel * (s * curve.d_u);
  known.col(1) = image.eliminated.kernel * (s * curve.d_q);
  known.col(2) = predicted;
  known.colwise().normalize();
  Doubts out;
  if (!known.allFinite() || !image.residual.allFinite()) return out;
  if (!free) {
    out.scale = doubt(image, known.leftCols(2), s * curve.r, optimum.log_s,
                      scale.relative_std * scale.relative_std, noise);
    out.scale.push = recovered.sqrt_information.leftCols(knots.size()) * (s * curve.r);
  }
  constexpr double kStep = 1e-3;
  const Eigen::VectorXd by_eta = s *
                                 (dipole_curve(knots, optimum.u, optimum.q, eta + kStep).r -
                                  dipole_curve(knots, optimum.u, optimum.q, eta - kStep).r) /
                                 (2.0 * kStep);
  out.eta = doubt(image, known.leftCols(scale.relative_std > 0.0 ? 3 : 2), by_eta, 0.0, 0.0, noise);
  out.eta.push = recovered.sqrt_information.leftCols(knots.size()) * by_eta;
  return out;
}

}  // namespace scattermeter
