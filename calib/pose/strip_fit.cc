#include "calib/pose/strip_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/Cholesky>

namespace scattermeter::calib {

StripFit::StripFit(std::vector<StripSample> samples, const Eigen::Vector2d& normal,
                   double per_count, bool both_bright)
    : samples_(std::move(samples)),
      normal_(normal),
      per_count_(per_count),
      columns_(kEdgeTerms + 1 + (both_bright ? 1 : 0)),
      weights_(samples_.size()),
      predicted_(samples_.size()),
      terms_(samples_.size()),
      basis_(samples_.size()) {
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
  linear_.fill(Column::Zero());
  normal_matrix_.fill(Square::Zero());
  const bool slope = columns_ == kMostColumns;
  for (Square& n : normal_matrix_) n(kMostColumns - 1, kMostColumns - 1) = slope ? 0.0 : 1.0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const StripSample& sample = samples_[i];
    const auto c = static_cast<std::size_t>(sample.channel);
    terms_[i] = shape.at(offset - sample.s);
    const auto& s = terms_[i].s;
    Column& b = basis_[i];
    b << 1.0, s[0], s[1], s[2], slope ? sample.s : 0.0;
    normal_matrix_[c].noalias() += weights_[i] * b * b.transpose();
    linear_[c] += weights_[i] * sample.signal_counts * b;
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
    linear_[c] = normal_matrix_[c].ldlt().solve(linear_[c]).eval();
  }
  double chi2 = 0;
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    predicted_[i] = basis_[i].dot(linear_[static_cast<std::size_t>(samples_[i].channel)]);
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

Eigen::Matrix2d StripFit::information(Eigen::Vector2d* gradient) const {
  Eigen::Matrix2d info = Eigen::Matrix2d::Zero();
  gradient->setZero();
  std::array<Eigen::Matrix<double, kMostColumns, 2>, 3> cross;
  cross.fill(Eigen::Matrix<double, kMostColumns, 2>::Zero());
  for (std::size_t i = 0; i < samples_.size(); ++i) {
    const auto c = static_cast<std::size_t>(samples_[i].channel);
    const EdgeShape::Terms& terms = terms_[i];
    Eigen::Vector2d by = Eigen::Vector2d::Zero();  // of the prediction
    for (std::size_t k = 0; k < kEdgeTerms; ++k) {
      by += linear_[c][static_cast<Eigen::Index>(k) + 1] *
            Eigen::Vector2d(terms.per_t[k], terms.per_blur[k]);
    }
    info.noalias() += weights_[i] * by * by.transpose();
    cross[c].noalias() += weights_[i] * basis_[i] * by.transpose();
    *gradient += weights_[i] * (samples_[i].signal_counts - predicted_[i]) * by;
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
    info -= cross[c].transpose() * normal_matrix_[c].ldlt().solve(cross[c]);
  }
  return info;
}

double StripFit::snr(double* sign) const {
  double sum = 0;
  *sign = 0;
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels_); ++c) {
    const Square covariance = normal_matrix_[c].ldlt().solve(Square::Identity());
    const double z = linear_[c][1] / std::sqrt(covariance(1, 1));
    sum += z * z;
    *sign += z;
  }
  return std::sqrt(sum);
}

}  // namespace scattermeter::calib
