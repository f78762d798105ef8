#include "core/fit/fit_uncertainty.h"

#include <algorithm>
#include <cmath>

#include "core/base/dense_solve.h"

namespace scattermeter {
namespace {

// Inverse of an information matrix, scaled to a unit diagonal first: the parameters differ by
// orders of magnitude.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& information) {
  const Eigen::VectorXd scaling = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scaling.asDiagonal() * information * scaling.asDiagonal();
  return scaling.asDiagonal() * SymmetricSolver(scaled).inverse() * scaling.asDiagonal();
}

}  // namespace

FitUncertainty::FitUncertainty(const RecoveredReflectance& recovered,
                               const std::vector<Nuisance>& nuisances, const DipoleCurve& curve,
                               double u, double q, double scale, const ScalePrior& prior,
                               double noise_inflation)
    : sigma_t_per_mm_(std::exp(u)), q_(q) {
  const auto kernel = recovered.sqrt_information.leftCols(curve.r.size());
  const auto n_fitted = static_cast<Eigen::Index>(std::count_if(
      nuisances.begin(), nuisances.end(), [](const Nuisance& v) { return v.fitted; }));
  const Eigen::Index n = 3 + n_fitted;
  Eigen::MatrixXd jacobian(recovered.whitened.size(), n);
  jacobian.col(0) = kernel * (scale * curve.d_u);
  jacobian.col(1) = kernel * (scale * curve.d_q);
  jacobian.col(2) = kernel * (scale * curve.r);
  jacobian.rightCols(n_fitted) = recovered.sqrt_information.middleCols(curve.r.size(), n_fitted);
  information_ = jacobian.transpose() * jacobian / noise_inflation;
  prior_ = Eigen::VectorXd::Zero(n);
  causes_ = {"", "", "scale"};
  if (prior.relative_std > 0.0) {
    movable_.push_back(2);
    if (!prior.is_free()) {
      prior_[2] = 1.0 / (prior.relative_std * prior.relative_std);
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(n_fitted); ++i) {
    const Eigen::Index at = 3 + static_cast<Eigen::Index>(i);
    movable_.push_back(at);
    prior_[at] = 1.0 / (nuisances[i].std * nuisances[i].std);
    causes_.push_back(nuisances[i].group);
  }
  information_.diagonal() += prior_;
  const Eigen::Index n_held = static_cast<Eigen::Index>(nuisances.size()) - n_fitted;
  held_ = jacobian.transpose() * recovered.sqrt_information.rightCols(n_held) / noise_inflation;
  for (Eigen::Index i = 0; i < n_held; ++i) {
    const Nuisance& nuisance = nuisances[static_cast<std::size_t>(n_fitted + i)];
    held_.col(i) *= nuisance.std;
    held_causes_.push_back(nuisance.group);
  }
}

Eigen::Matrix2d FitUncertainty::covariance(
    const std::function<bool(const std::string&)>& known) const {
  std::vector<Eigen::Index> free = {0, 1};
  for (Eigen::Index i : movable_) {
    if (!known(causes_[static_cast<std::size_t>(i)])) free.push_back(i);
  }
  const Eigen::MatrixXd inverse = inverse_of(information_(free, free));
  Eigen::MatrixXd all = inverse;
  for (Eigen::Index i = 0; i < held_.cols(); ++i) {
    if (known(held_causes_[static_cast<std::size_t>(i)])) continue;
    const Eigen::VectorXd push = inverse * held_.col(i)(free);
    all += push * push.transpose();
  }
  return in_sigma(all.topLeftCorner(2, 2));
}

Eigen::Matrix2d FitUncertainty::in_sigma(const Eigen::Matrix2d& of_u_and_q) const {
  Eigen::Matrix2d to_sigma;  // d(sigma_s', sigma_a) / d(u, q)
  to_sigma << (1.0 - q_) * sigma_t_per_mm_, -sigma_t_per_mm_, q_ * sigma_t_per_mm_, sigma_t_per_mm_;
  return to_sigma * of_u_and_q * to_sigma.transpose();
}

Eigen::Matrix2d FitUncertainty::covariance_of_fitted() const {
  return covariance([&](const std::string& cause) {
    return std::find(held_causes_.begin(), held_causes_.end(), cause) != held_causes_.end();
  });
}

std::vector<Eigen::Index> FitUncertainty::free_parameters() const {
  std::vector<Eigen::Index> free = {0, 1};
  free.insert(free.end(), movable_.begin(), movable_.end());
  return free;
}

double FitUncertainty::log_scale_std() const {
  if (movable_.empty() || movable_.front() != 2) return 0.0;
  const std::vector<Eigen::Index> free = free_parameters();
  return std::sqrt(inverse_of(information_(free, free))(2, 2));
}

Eigen::Matrix2d FitUncertainty::by_noise() const {
  const std::vector<Eigen::Index> free = free_parameters();
  // The inverse C of the information is C (that of the data) C + C (that of the priors) C.
  const Eigen::MatrixXd inverse = inverse_of(information_(free, free));
  const Eigen::MatrixXd by_priors = inverse.topRows(2) * prior_(free).asDiagonal();
  return in_sigma(inverse.topLeftCorner<2, 2>() - by_priors * inverse.leftCols(2));
}

std::vector<std::string> FitUncertainty::causes() const {
  std::vector<std::string> out;
  for (Eigen::Index i : movable_) {
    const std::string& cause = causes_[static_cast<std::size_t>(i)];
    if (std::find(out.begin(), out.end(), cause) == out.end()) out.push_back(cause);
  }
  for (const std::string& cause : held_causes_) {
    if (std::find(out.begin(), out.end(), cause) == out.end()) out.push_back(cause);
  }
  return out;
}

std::vector<MoreRows> more_rows(const std::function<FitUncertainty(double)>& with, double all) {
  std::vector<MoreRows> out;
  for (double times = 1.0; all > 1.0; times = std::min(2.0 * times, all)) {
    const Eigen::Matrix2d c = with(times).covariance([](const std::string&) { return false; });
    out.push_back({times, std::sqrt(c(0, 0)), std::sqrt(c(1, 1))});
    if (times == all) break;
  }
  return out;
}

}  // namespace scattermeter
