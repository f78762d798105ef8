#include "calib/lens/lens_uncertainty.h"

#include <array>
#include <cmath>
#include <map>

#include "core/base/chi_square.h"
#include "core/base/symmetric_eigen.h"

namespace scattermeter::calib {
namespace {

constexpr double kByChance = 1e-3;

}  // namespace

LensUncertainty lens_uncertainty(const std::vector<BoardView>& views,
                                 const std::vector<ViewEquations>& equations, double board_std_mm) {
  LensUncertainty out;
  if (equations.empty()) return out;
  const Eigen::Index p = equations.front().information.rows();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(p, p);
  double sum_squares = 0;
  double freedom = -static_cast<double>(p);
  for (const ViewEquations& e : equations) {
    information += e.information;
    sum_squares += e.sum_squares_px2;
    freedom += 2 * static_cast<double>(e.n_corners) - 6;
  }
  // Focal lengths are in the thousands, distortion terms in the tenths, so all are scaled first.
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite() || !(freedom > 0)) return out;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * information * scale.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(scaled);
  if (!(eigen.values[0] > 1e-13)) return out;
  const Eigen::MatrixXd inverse = scale.asDiagonal() * eigen.vectors *
                                  eigen.values.cwiseInverse().asDiagonal() *
                                  eigen.vectors.transpose() * scale.asDiagonal();
  const double variance = sum_squares / freedom;
  out.determined = true;
  out.noise_std_px = std::sqrt(variance);
  out.covariance = variance * inverse;

  double scatter = 0, expected = 0, expected_squares = 0;
  for (const ViewEquations& e : equations) {
    const Eigen::MatrixXd w = inverse * e.information;
    const Eigen::MatrixXd rest = w - w * w;
    const double own = e.gradient.dot(inverse * e.gradient);
    scatter += own;
    expected += rest.trace();
    expected_squares += (rest * rest).trace();
    out.scatter_of_view.push_back(variance > 0 ? own / (variance * rest.trace()) : 0.0);
  }
  if (variance > 0 && expected > 0 && expected_squares > 0) {
    out.view_scatter = scatter / (variance * expected);
    const double views_freedom = expected * expected / expected_squares;
    out.view_scatter_p = chi_square_tail(out.view_scatter * views_freedom, views_freedom);
    out.widened = out.view_scatter > 1 && out.view_scatter_p < kByChance;
    if (out.widened) out.covariance *= out.view_scatter;
  }

  if (board_std_mm > 0) {
    std::map<std::array<long long, 3>, Eigen::MatrixXd> per_mm;
    for (std::size_t i = 0; i < views.size(); ++i) {
      for (std::size_t c = 0; c < views[i].corners.size(); ++c) {
        const Eigen::Vector3d x = 1e6 * views[i].corners[c].world_mm;
        const auto [at, is_new] =
            per_mm.try_emplace({std::llround(x.x()), std::llround(x.y()), std::llround(x.z())},
                               Eigen::MatrixXd::Zero(p, 3));
        at->second += equations[i].gradient_per_mm[c];
      }
    }
    for (const auto& [place, gradient] : per_mm) {
      const Eigen::MatrixXd step = board_std_mm * inverse * gradient;
      out.covariance += step * step.transpose();
    }
  }
  return out;
}

}  // namespace scattermeter::calib
