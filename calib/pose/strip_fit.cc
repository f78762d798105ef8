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
  linear_.setZero(columns_, channels_);
  for (Square& n : normal_matrix_) n.setZero(columns_, columns_);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto c = static_cast<std::size_t>(samples_[i].channel);
    const auto b = basis_.row(index(i)).transpose();
    normal_matrix_[c].noalias() += (weights_[i] * b).lazyProduct(b.transpose());
    linear_.col(samples_[i].channel) += weights_[i] * samples_[i].signal_counts * b;
  }
  for (int c = 0; c < channels_; ++c) {
    linear_.col(c) =
        normal_matrix_[static_cast<std::size_t>(c)].ldlt().solve(linear_.col(c).eval());
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
  Eigen::Matrix<double, Eigen::Dynamic, 2> j(index(samples_.size()), 2);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto a = linear_.col(samples_[i].channel);
    j(index(i), 0) =
        (row(shape, offset + kStep, i) - row(shape, offset - kStep, i)).dot(a) / (2 * kStep);
    j(index(i), 1) = (row(wider, offset, i) - row(narrower, offset, i)).dot(a) / (2 * kStep);
  }
  Eigen::Matrix2d info = Eigen::Matrix2d::Zero();
  gradient->setZero();
  std::array<Eigen::Matrix<double, Eigen::Dynamic, 2, 0, kMostColumns>, 3> cross;
  for (auto& of_channel : cross) of_channel.setZero(columns_, 2);
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto by = j.row(index(i));
    info.noalias() += (weights_[i] * by.transpose()).lazyProduct(by);
    cross[static_cast<std::size_t>(samples_[i].channel)].noalias() +=
        (weights_[i] * basis_.row(index(i)).transpose()).lazyProduct(by);
    *gradient += weights_[i] * (samples_[i].signal_counts - predicted_[i]) * by.transpose();
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
    info -= cross[c].transpose() * normal_matrix_[c].ldlt().solve(cross[c]);
  }
  return info;
}

double StripFit::snr(double* sign) const {
  double sum = 0;
  *sign = 0;
  for (int c = 0; c < channels_; ++c) {
    const Square covariance = normal_matrix_[static_cast<std::size_t>(c)].ldlt().solve(
        Square::Identity(columns_, columns_));
    const double z = linear_(1, c) / std::sqrt(covariance(1, 1));
    sum += z * z;
    *sign += z;
  }
  return std::sqrt(sum);
}

StripFit::Row StripFit::row(const EdgeShape& shape, double offset, std::size_t i) const {
  const auto s = shape.at(offset - samples_[i].s);
  Row r(columns_);
  r.head<4>() << 1.0, s[0], s[1], s[2];
  if (columns_ > 4) r[4] = samples_[i].s;
  return r;
}

}  // namespace scattermeter::calib
