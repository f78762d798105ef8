#include "calib/pose/strip_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

namespace scattermeter::calib {
namespace {

Eigen::Index index(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

StripFit::StripFit(std::vector<StripSample> samples, const Eigen::Vector2d& normal,
                   double per_count, bool both_bright)
    : samples_(std::move(samples)),
      normal_(normal),
      per_count_(per_count),
      columns_(kEdgeTerms + 1 + (both_bright ? 1 : 0)),
      weights_(samples_.size()),
      predicted_(samples_.size()) {
  // Channels are numbered consecutively in the order of their first samples.
  std::array<int, 3> dense = {-1, -1, -1};
  for (StripSample& s : samples_) {
    auto& p = dense[static_cast<std::size_t>(s.channel)];
    if (p < 0) p = channels_++;
    s.channel = p;
  }
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    weights_[i] = 1.0 / (samples_[i].dark_variance_counts2 +
                         per_count_ * std::max(0.0, samples_[i].signal_counts));
  }
}

double StripFit::solve(double offset, double blur) {
  const EdgeShape shape(normal_, blur);
  basis_.resize(index(samples_.size()), columns_);
  for (std::size_t i = 0; i < samples_.size(); ++i) basis_.row(index(i)) = row(shape, offset, i);
  linear_.resize(columns_, channels_);
  normal_matrix_.resize(static_cast<std::size_t>(channels_));
  for (int c = 0; c < channels_; ++c) {
    Eigen::MatrixXd n = Eigen::MatrixXd::Zero(columns_, columns_);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(columns_);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (samples_[i].channel != c) continue;
      n += weights_[i] * basis_.row(index(i)).transpose() * basis_.row(index(i));
      g += weights_[i] * samples_[i].signal_counts * basis_.row(index(i)).transpose();
    }
    linear_.col(c) = n.ldlt().solve(g);
    normal_matrix_[static_cast<std::size_t>(c)] = n;
  }
  double chi2 = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    predicted_[i] = basis_.row(index(i)).dot(linear_.col(samples_[i].channel));
    const double r = samples_[i].signal_counts - predicted_[i];
    chi2 += weights_[i] * r * r;
  }
  return std::isfinite(chi2) ? chi2 : std::numeric_limits<double>::infinity();
}

void StripFit::reweigh() {
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    weights_[i] =
        1.0 / (samples_[i].dark_variance_counts2 + per_count_ * std::max(0.0, predicted_[i]));
  }
}

Eigen::Matrix2d StripFit::information(double offset, double blur, Eigen::Vector2d* gradient) const {
  constexpr double kStep = 1e-4;
  const EdgeShape wider(normal_, blur + kStep);
  const EdgeShape narrower(normal_, blur - kStep);
  const EdgeShape shape(normal_, blur);
  Eigen::MatrixXd j(index(samples_.size()), 2);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto a = linear_.col(samples_[i].channel);
    j(index(i), 0) =
        (row(shape, offset + kStep, i) - row(shape, offset - kStep, i)).dot(a) / (2 * kStep);
    j(index(i), 1) = (row(wider, offset, i) - row(narrower, offset, i)).dot(a) / (2 * kStep);
  }
  Eigen::Matrix2d info = Eigen::Matrix2d::Zero();
  gradient->setZero();
  for (int c = 0; c < channels_; ++c) {
    Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(columns_, 2);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      if (samples_[i].channel != c) continue;
      info += weights_[i] * j.row(index(i)).transpose() * j.row(index(i));
      cross += weights_[i] * basis_.row(index(i)).transpose() * j.row(index(i));
      *gradient +=
          weights_[i] * (samples_[i].signal_counts - predicted_[i]) * j.row(index(i)).transpose();
    }
    info -= cross.transpose() * normal_matrix_[static_cast<std::size_t>(c)].ldlt().solve(cross);
  }
  return info;
}

double StripFit::snr(double* sign) const {
  double sum = 0;
  *sign = 0;
  for (int c = 0; c < channels_; ++c) {
    const Eigen::MatrixXd covariance = normal_matrix_[static_cast<std::size_t>(c)].ldlt().solve(
        Eigen::MatrixXd::Identity(columns_, columns_));
    const double z = linear_(1, c) / std::sqrt(covariance(1, 1));
    sum += z * z;
    *sign += z;
  }
  return std::sqrt(sum);
}

Eigen::RowVectorXd StripFit::row(const EdgeShape& shape, double offset, std::size_t i) const {
  const auto s = shape.at(offset - samples_[i].s);
  Eigen::RowVectorXd r(columns_);
  r.head<4>() << 1.0, s[0], s[1], s[2];
  if (columns_ > 4) r[4] = samples_[i].s;
  return r;
}

}  // namespace scattermeter::calib
