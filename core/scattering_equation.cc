#include "core/scattering_equation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <Eigen/Cholesky>
#include <Eigen/LU>

namespace scattermeter {

Eigen::MatrixXd ScatteringEquation::jacobian(const ScatteringImage& m, const ScatteringPoint& at,
                                             bool scale_moves) {
  Eigen::MatrixXd j(m.l.size(), scale_moves ? 3 : 2);
  j.col(0) = at.scale * m.per_log_sigma_s;
  j.col(1) = at.scale * m.per_sigma_a;
  if (scale_moves) j.col(2) = at.scale * m.l;
  return j;
}

ScatteringEquation::ScatteringEquation(const DenseSystem& system, const ScalePrior& scale,
                                       const ScatteringImage& pilot, const ScatteringPoint& at,
                                       double monte_carlo)
    : system_(system), scale_(scale) {
  const Eigen::Index rows = system.l.size();
  if (pilot.l.size() != rows) {
    throw std::invalid_argument("ScatteringEquation: image and system differ in rows");
  }
  row_variance_ = system.std_l.cwiseAbs2() + monte_carlo * at.scale * at.scale * pilot.variance;
  nuisances_ = system.nuisance_columns;
  if (nuisances_.size() == 0) nuisances_.resize(rows, 0);
  for (Eigen::Index i = 0; i < nuisances_.cols(); ++i) {
    const double std = system.nuisances[static_cast<std::size_t>(i)].std;
    // A free nuisance: far wider than anything the rows could leave undecided.
    constexpr double kWide = 1e3;
    const double size = nuisances_.col(i).norm();
    nuisances_.col(i) *=
        std::isfinite(std) ? std : (size > 0.0 ? kWide * system.l.norm() / size : 0.0);
  }
  const Eigen::MatrixXd weighted = row_variance_.cwiseInverse().asDiagonal() * nuisances_;
  capacitance_ = (Eigen::MatrixXd::Identity(nuisances_.cols(), nuisances_.cols()) +
                  nuisances_.transpose() * weighted)
                     .inverse();
  const Eigen::MatrixXd z = jacobian(pilot, at, scale.relative_std > 0.0);
  projection_.resize(z.cols(), rows);
  for (Eigen::Index k = 0; k < z.cols(); ++k) {
    projection_.row(k) = solve_covariance(z.col(k)).transpose();
  }
}

Eigen::VectorXd ScatteringEquation::solve_covariance(const Eigen::VectorXd& rows) const {
  const Eigen::VectorXd direct = rows.cwiseQuotient(row_variance_);
  if (nuisances_.cols() == 0) return direct;
  const Eigen::VectorXd inner = capacitance_ * (nuisances_.transpose() * direct);
  return direct - (nuisances_ * inner).cwiseQuotient(row_variance_);
}

ScatteringEquation::Step ScatteringEquation::step(const ScatteringImage& m,
                                                  const Eigen::MatrixXd& projected_covariance,
                                                  const ScatteringPoint& at, double scatter) const {
  const Eigen::Index n = projection_.rows();
  const bool prior = n == 3 && std::isfinite(scale_.relative_std);
  const double precision = prior ? 1.0 / (scale_.relative_std * scale_.relative_std) : 0.0;
  Eigen::MatrixXd slope = projection_ * jacobian(m, at, n == 3);
  Eigen::VectorXd misfit = projection_ * (system_.l - at.scale * m.l);
  if (n == 3) {
    slope(2, 2) += precision;
    misfit[2] -= precision * std::log(at.scale);
  }
  const Eigen::MatrixXd inverse = slope.inverse();
  Eigen::VectorXd move = inverse * misfit;
  const double most = std::log(1.5);
  const double sigma_t = at.sigma_s_per_mm + at.sigma_a_per_mm;
  const double largest =
      std::max({std::abs(move[0]), std::abs(move[1]) / sigma_t, n == 3 ? std::abs(move[2]) : 0.0});
  Step out;
  out.move = move;
  out.inverse = inverse;
  out.change = largest;
  if (largest > most) move *= most / largest;
  out.to = {at.sigma_s_per_mm * std::exp(move[0]), std::max(0.0, at.sigma_a_per_mm + move[1]),
            n == 3 ? at.scale * std::exp(move[2]) : at.scale};
  const auto add = [&](const std::string& name, const Eigen::MatrixXd& of_projection) {
    out.causes.push_back({name, inverse * of_projection * inverse.transpose()});
  };
  add("noise", projection_ * system_.std_l.cwiseAbs2().asDiagonal() * projection_.transpose());
  const Eigen::MatrixXd monte_carlo = at.scale * at.scale * projected_covariance;
  add("Monte Carlo", monte_carlo);
  if (scatter > 1.0) add("scatter", (scatter - 1.0) * monte_carlo);
  out.pushes = Eigen::MatrixXd::Zero(n, nuisances_.cols() + (prior ? 1 : 0));
  out.pushes.leftCols(nuisances_.cols()) = inverse * (projection_ * nuisances_);
  if (prior) {
    Eigen::MatrixXd scale = Eigen::MatrixXd::Zero(n, n);
    scale(2, 2) = precision;
    add("scale", scale);
    out.pushes.rightCols(1) = std::sqrt(precision) * inverse.col(2);
  }
  std::map<std::string, Eigen::MatrixXd> groups;
  for (Eigen::Index i = 0; i < nuisances_.cols(); ++i) {
    const Eigen::VectorXd push = projection_ * nuisances_.col(i);
    Eigen::MatrixXd& sum = groups
                               .try_emplace(system_.nuisances[static_cast<std::size_t>(i)].group,
                                            Eigen::MatrixXd::Zero(n, n))
                               .first->second;
    sum += push * push.transpose();
  }
  for (const auto& [name, covariance] : groups) add(name, covariance);
  out.covariance = Eigen::MatrixXd::Zero(n, n);
  for (const Step::Cause& cause : out.causes) out.covariance += cause.covariance;
  return out;
}

Eigen::VectorXd ScatteringEquation::residual(const ScatteringImage& m, const ScatteringPoint& at,
                                             const ScatteringPoint& to) const {
  return system_.l - to.scale * m.l -
         at.scale * (std::log(to.sigma_s_per_mm / at.sigma_s_per_mm) * m.per_log_sigma_s +
                     (to.sigma_a_per_mm - at.sigma_a_per_mm) * m.per_sigma_a);
}

Eigen::VectorXd ScatteringEquation::without_nuisances(const Eigen::VectorXd& residual) const {
  return row_variance_.cwiseProduct(solve_covariance(residual));
}

}  // namespace scattermeter
