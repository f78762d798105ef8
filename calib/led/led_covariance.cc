#include "calib/led/led_covariance.h"

#include <limits>
#include <vector>

#include "core/base/symmetric_eigen.h"

namespace scattermeter::calib {

std::set<Eigen::Index> free_ambient_indices(const LedScene& scene, const LedSolve& what,
                                            const LedSolution& solution) {
  std::set<Eigen::Index> indices;
  for (std::size_t i = 0; i < what.use_cell.size(); ++i) {
    const ShadedCell& cell = scene.cells[i];
    if (!what.use_cell[i] || !what.free_ambient[cell.shot]) continue;
    indices.insert(solution.ambient_at + 3 * static_cast<Eigen::Index>(cell.shot) + cell.channel);
  }
  return indices;
}

LedCovariance led_covariance(const LedScene& scene, const LedSolve& what,
                             const LedSolution& solution, double highlight_inflation,
                             double plane_inflation) {
  Eigen::MatrixXd info = solution.highlight_information / highlight_inflation +
                         solution.cell_information / plane_inflation;
  const Eigen::Index size = info.rows();
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < kLedParameters; ++i) {
    if (what.free[static_cast<std::size_t>(i)]) kept.push_back(i);
  }
  for (const Eigen::Index i : free_ambient_indices(scene, what, solution)) kept.push_back(i);
  for (Eigen::Index i = solution.nuisances_at; i < size; ++i) {
    info(i, i) += 1.0;
    kept.push_back(i);
  }
  const Eigen::MatrixXd some = info(kept, kept);
  const Eigen::VectorXd scale = some.diagonal().cwiseSqrt().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * some * scale.asDiagonal();
  const SymmetricEigen eigen = symmetric_eigen(scaled);
  LedCovariance out;
  out.determined = eigen.values[0] > 1e-12;
  if (!out.determined) {
    out.covariance.setConstant(size, size, std::numeric_limits<double>::quiet_NaN());
    out.open_combination.setZero(size);
    for (std::size_t k = 0; scaled.allFinite() && k < kept.size(); ++k) {
      if (kept[k] < solution.nuisances_at) {
        out.open_combination[kept[k]] = eigen.vectors(static_cast<Eigen::Index>(k), 0);
      }
    }
    return out;
  }
  const Eigen::MatrixXd inverse =
      scale.asDiagonal() *
      (eigen.vectors * eigen.values.cwiseInverse().asDiagonal() * eigen.vectors.transpose()) *
      scale.asDiagonal();
  out.covariance.setZero(size, size);
  out.covariance(kept, kept) = inverse;
  return out;
}

LedUncertainty led_uncertainty(const Eigen::MatrixXd& covariance, const LedSolution& solution,
                               const Led& led, bool albedo_is_uncertain) {
  LedUncertainty u;
  u.tangents = solution.tangents;
  // The axis has moved a little since its tangents were chosen.
  u.tangents[0] = (u.tangents[0] - u.tangents[0].dot(led.axis) * led.axis).normalized();
  u.tangents[1] = led.axis.cross(u.tangents[0]);
  u.covariance = covariance.topLeftCorner<kLedParameters, kLedParameters>();
  u.covariance = (0.5 * (u.covariance + u.covariance.transpose())).eval();
  // The response of the estimate to an error of the albedo's prior: covariance times the
  // information of that prior, which is 1. The albedo is the last unknown.
  u.common.setZero();
  if (albedo_is_uncertain) {
    u.common = covariance.block<kLedParameters, 1>(0, covariance.cols() - 1);
  }
  return u;
}

}  // namespace scattermeter::calib
