#include "calib/pose/edge_strip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/Cholesky>

namespace scattermeter::calib {
namespace {

constexpr double kMinBlur = 0.02;  // px; the pixel's own box is several times wider
constexpr int kTerms = 3;          // S_0, S_1, S_2

struct StripSample {
  double s;  // along outward from where the edge is looked for, px
  double signal;
  double dark_variance;  // without photon noise
  int channel;
};

// S_k(t), k = 0 .. 2.
class EdgeShape {
 public:
  EdgeShape(const Eigen::Vector2d& normal, double blur_px)
      : a_(std::max(std::abs(normal.x()), 1e-3)),
        b_(std::max(std::abs(normal.y()), 1e-3)),
        blur_(blur_px) {}

  std::array<double, kTerms> at(double t) const {
    const double far = 0.5 * (a_ + b_);
    const double near = 0.5 * (a_ - b_);
    const auto p = integrals(t + far);
    const auto q = integrals(t + near);
    const auto r = integrals(t - near);
    const auto u = integrals(t - far);
    std::array<double, kTerms> out{};
    for (std::size_t k = 0; k < kTerms; ++k) {
      out[k] = (k == 2 ? 2.0 : 1.0) * (p[k] - q[k] - r[k] + u[k]) / (a_ * b_);
    }
    return out;
  }

 private:
  // F_2, F_3, F_4.
  std::array<double, 3> integrals(double t) const {
    const double z = t / blur_;
    if (z < -9) return {0, 0, 0};
    const double v = blur_ * blur_;
    const double density =
        std::abs(z) > 9 ? 0.0 : std::exp(-0.5 * z * z) / (blur_ * std::sqrt(2 * std::numbers::pi));
    const double f0 = z > 9 ? 1.0 : 0.5 * std::erfc(-z / std::numbers::sqrt2);
    const double f1 = t * f0 + v * density;
    const double f2 = (t * f1 + v * f0) / 2;
    const double f3 = (t * f2 + v * f1) / 3;
    return {f2, f3, (t * f3 + v * f2) / 4};
  }

  double a_;
  double b_;
  double blur_;
};

class StripFit {
 public:
  StripFit(std::vector<StripSample> samples, const Eigen::Vector2d& normal, double per_count,
           bool both_bright)
      : samples_(std::move(samples)),
        normal_(normal),
        per_count_(per_count),
        columns_(kTerms + 1 + (both_bright ? 1 : 0)),
        weights_(samples_.size()),
        predicted_(samples_.size()) {
    std::array<int, 3> place = {-1, -1, -1};
    for (StripSample& s : samples_) {
      auto& p = place[static_cast<std::size_t>(s.channel)];
      if (p < 0) p = channels_++;
      s.channel = p;
    }
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      weights_[i] =
          1.0 / (samples_[i].dark_variance + per_count_ * std::max(0.0, samples_[i].signal));
    }
  }

  int unknowns() const { return channels_ * columns_ + 2; }
  double samples() const { return static_cast<double>(samples_.size()); }

  // Best brightnesses for this edge: chi2; keeps them and what they predict.
  double solve(double offset, double blur) {
    const EdgeShape shape(normal_, blur);
    basis_.resize(static_cast<Eigen::Index>(samples_.size()), columns_);
    for (std::size_t i = 0; i < samples_.size(); ++i) basis_.row(at(i)) = row(shape, offset, i);
    linear_.resize(columns_, channels_);
    normal_matrix_.resize(static_cast<std::size_t>(channels_));
    for (int c = 0; c < channels_; ++c) {
      Eigen::MatrixXd n = Eigen::MatrixXd::Zero(columns_, columns_);
      Eigen::VectorXd g = Eigen::VectorXd::Zero(columns_);
      for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (samples_[i].channel != c) continue;
        n += weights_[i] * basis_.row(at(i)).transpose() * basis_.row(at(i));
        g += weights_[i] * samples_[i].signal * basis_.row(at(i)).transpose();
      }
      linear_.col(c) = n.ldlt().solve(g);
      normal_matrix_[static_cast<std::size_t>(c)] = n;
    }
    chi2_ = 0;
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      predicted_[i] = basis_.row(at(i)).dot(linear_.col(samples_[i].channel));
      const double r = samples_[i].signal - predicted_[i];
      chi2_ += weights_[i] * r * r;
    }
    return std::isfinite(chi2_) ? chi2_ : std::numeric_limits<double>::infinity();
  }

  // Weights from what the last solve() predicts.
  void reweigh() {
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      weights_[i] = 1.0 / (samples_[i].dark_variance + per_count_ * std::max(0.0, predicted_[i]));
    }
  }

  // Gauss-Newton step of (offset, blur) with the brightnesses eliminated, and the information
  // about the two. After solve(offset, blur).
  Eigen::Matrix2d information(double offset, double blur, Eigen::Vector2d* gradient) const {
    constexpr double kStep = 1e-4;
    const EdgeShape wider(normal_, blur + kStep);
    const EdgeShape narrower(normal_, blur - kStep);
    const EdgeShape shape(normal_, blur);
    Eigen::MatrixXd j(static_cast<Eigen::Index>(samples_.size()), 2);
    for (std::size_t i = 0; i < samples_.size(); ++i) {
      const auto a = linear_.col(samples_[i].channel);
      j(at(i), 0) =
          (row(shape, offset + kStep, i) - row(shape, offset - kStep, i)).dot(a) / (2 * kStep);
      j(at(i), 1) = (row(wider, offset, i) - row(narrower, offset, i)).dot(a) / (2 * kStep);
    }
    Eigen::Matrix2d info = Eigen::Matrix2d::Zero();
    gradient->setZero();
    for (int c = 0; c < channels_; ++c) {
      Eigen::MatrixXd cross = Eigen::MatrixXd::Zero(columns_, 2);
      for (std::size_t i = 0; i < samples_.size(); ++i) {
        if (samples_[i].channel != c) continue;
        info += weights_[i] * j.row(at(i)).transpose() * j.row(at(i));
        cross += weights_[i] * basis_.row(at(i)).transpose() * j.row(at(i));
        *gradient += weights_[i] * (samples_[i].signal - predicted_[i]) * j.row(at(i)).transpose();
      }
      info -= cross.transpose() * normal_matrix_[static_cast<std::size_t>(c)].ldlt().solve(cross);
    }
    return info;
  }

  // Signal to noise of the step, and its sign summed over the channels.
  double snr(double* sign) const {
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

 private:
  static Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

  Eigen::RowVectorXd row(const EdgeShape& shape, double offset, std::size_t i) const {
    const auto s = shape.at(offset - samples_[i].s);
    Eigen::RowVectorXd r(columns_);
    r.head<4>() << 1.0, s[0], s[1], s[2];
    if (columns_ > 4) r[4] = samples_[i].s;
    return r;
  }

  std::vector<StripSample> samples_;
  Eigen::Vector2d normal_;
  double per_count_;
  int columns_;
  int channels_ = 0;
  std::vector<double> weights_;
  std::vector<double> predicted_;
  Eigen::MatrixXd basis_;
  Eigen::MatrixXd linear_;  // column a channel: b, a_0, a_1, a_2 [, c]
  std::vector<Eigen::MatrixXd> normal_matrix_;
  double chi2_ = 0;
};

// Samples of the strip; empty where it leaves the picture or meets a clipped one.
std::vector<StripSample> samples_in(const CfaSamples& samples, const Eigen::Vector2d& at_px,
                                    const Eigen::Vector2d& outward,
                                    const EdgeStripOptions& options) {
  const Eigen::Vector2d along(-outward.y(), outward.x());
  const double half_s = options.half_width_px + options.search_px;
  const double reach = std::hypot(options.half_length_px, half_s);
  const int x_low = static_cast<int>(std::floor(at_px.x() - reach));
  const int x_high = static_cast<int>(std::ceil(at_px.x() + reach));
  const int y_low = static_cast<int>(std::floor(at_px.y() - reach));
  const int y_high = static_cast<int>(std::ceil(at_px.y() + reach));
  std::vector<StripSample> out;
  for (int y = y_low; y <= y_high; ++y) {
    for (int x = x_low; x <= x_high; ++x) {
      const Eigen::Vector2d d(x - at_px.x(), y - at_px.y());
      const double s = d.dot(outward);
      // Half open, so that strips end to end share no sample.
      const double l = d.dot(along);
      if (std::abs(s) > half_s || l < -options.half_length_px || l >= options.half_length_px) {
        continue;
      }
      const int ix = x - samples.x0;
      const int iy = y - samples.y0;
      if (ix < 0 || iy < 0 || ix >= samples.width || iy >= samples.height) return {};
      const std::size_t i = static_cast<std::size_t>(iy) * static_cast<std::size_t>(samples.width) +
                            static_cast<std::size_t>(ix);
      if (samples.clipped[i] != 0) return {};
      const auto signal = static_cast<double>(samples.signal_counts[i]);
      const auto variance = static_cast<double>(samples.variance_counts2[i]);
      const double photon = samples.variance_per_count * std::max(0.0, signal);
      out.push_back(
          {s, signal, std::max(variance - photon, 1e-3 * variance + 1e-12), samples.channel(x, y)});
    }
  }
  return out;
}

}  // namespace

EdgeStrip locate_edge(const CfaSamples& samples, const Eigen::Vector2d& at_px,
                      const Eigen::Vector2d& outward, const EdgeStripOptions& options) {
  if (!(std::abs(outward.norm() - 1) < 1e-6) || !at_px.allFinite()) {
    throw std::invalid_argument("locate_edge: outward must be a unit vector, at_px finite");
  }
  EdgeStrip out;
  std::vector<StripSample> strip = samples_in(samples, at_px, outward, options);
  StripFit fit(std::move(strip), outward, samples.variance_per_count, options.both_bright);
  if (fit.samples() < fit.unknowns() + 10) return out;
  // On a grid: the cost has several minima where shading or noise is strong.
  double best = std::numeric_limits<double>::infinity();
  double offset = 0;
  double blur = options.blur_px.value_or(0.5);
  const int steps = std::max(1, static_cast<int>(std::ceil(2 * options.search_px)));
  for (const double coarse_blur : {0.3, 1.0}) {
    const double b = options.blur_px.value_or(coarse_blur);
    for (int i = -steps; i <= steps; ++i) {
      const double o = options.search_px * i / steps;
      const double chi2 = fit.solve(o, b);
      if (chi2 < best) {
        best = chi2;
        offset = o;
        blur = b;
      }
    }
  }
  if (!std::isfinite(best)) return out;
  // Gauss-Newton, halved where it does not gain; weights anew at the first steps.
  Eigen::Matrix2d info;
  double chi2 = 0;
  bool fixed_blur = false;
  for (int iteration = 0; iteration < 25; ++iteration) {
    chi2 = fit.solve(offset, blur);
    if (iteration < 4) {
      fit.reweigh();
      chi2 = fit.solve(offset, blur);
    }
    Eigen::Vector2d gradient;
    info = fit.information(offset, blur, &gradient);
    fixed_blur =
        (blur <= kMinBlur && gradient[1] < 0) || (blur >= options.max_blur_px && gradient[1] > 0);
    Eigen::Vector2d step(gradient[0] / info(0, 0), 0);
    if (!fixed_blur) step = info.ldlt().solve(gradient);
    if (!step.allFinite()) return out;
    double share = 1;
    bool gained = false;
    for (int halving = 0; halving < 8 && !gained; ++halving, share *= 0.5) {
      const double o = offset + std::clamp(share * step[0], -0.5, 0.5);
      const double b = options.blur_px.value_or(
          std::clamp(blur + std::clamp(share * step[1], -0.4, 0.4), kMinBlur, options.max_blur_px));
      if (fit.solve(o, b) <= chi2 + 1e-9) {
        gained = true;
        const double moved = std::abs(o - offset);
        offset = o;
        blur = b;
        if (iteration >= 4 && moved < 1e-5) iteration = 100;
      }
    }
    if (!gained && iteration >= 4) break;
  }
  chi2 = fit.solve(offset, blur);
  Eigen::Vector2d gradient;
  info = fit.information(offset, blur, &gradient);
  // With the blur eliminated.
  const double left = fixed_blur || blur <= kMinBlur
                          ? info(0, 0)
                          : info(0, 0) - info(0, 1) * info(0, 1) / info(1, 1);
  const double variance = 1.0 / left;
  double sign = 0;
  out.snr = fit.snr(&sign);
  out.offset_px = offset;
  out.blur_px = blur;
  out.reduced_chi2 = chi2 / (fit.samples() - fit.unknowns());
  out.std_px = std::sqrt(variance * std::max(1.0, out.reduced_chi2));
  out.found = std::isfinite(out.std_px) && variance > 0 && out.snr >= options.min_snr &&
              (options.both_bright || sign > 0) && std::abs(offset) <= options.search_px;
  return out;
}

CfaSamples cell_means(const CfaSamples& samples, int factor) {
  if (factor < 2 || factor % 2 != 0) {
    throw std::invalid_argument("cell_means: factor must be even, got " + std::to_string(factor));
  }
  const auto up = [factor](int v) { return (v + factor - 1) / factor; };
  CfaSamples out;
  out.x0 = up(samples.x0);
  out.y0 = up(samples.y0);
  out.width = std::max(0, (samples.x0 + samples.width) / factor - out.x0);
  out.height = std::max(0, (samples.y0 + samples.height) / factor - out.y0);
  out.channel_of_phase = {1, 1, 1, 1};
  out.exposure_s = samples.exposure_s;
  const double n = static_cast<double>(factor) * factor;
  out.variance_per_count = samples.variance_per_count / n;
  out.floor_counts = samples.floor_counts;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      double signal = 0;
      double variance = 0;
      std::uint8_t clipped = 0;
      for (int j = 0; j < factor; ++j) {
        const std::size_t row = static_cast<std::size_t>((out.y0 + y) * factor + j - samples.y0) *
                                static_cast<std::size_t>(samples.width);
        for (int i = 0; i < factor; ++i) {
          const std::size_t at =
              row + static_cast<std::size_t>((out.x0 + x) * factor + i - samples.x0);
          signal += static_cast<double>(samples.signal_counts[at]);
          variance += static_cast<double>(samples.variance_counts2[at]);
          clipped = std::max(clipped, samples.clipped[at]);
        }
      }
      out.signal_counts.push_back(static_cast<float>(signal / n));
      out.variance_counts2.push_back(static_cast<float>(variance / (n * n)));
      out.clipped.push_back(clipped);
    }
  }
  return out;
}

}  // namespace scattermeter::calib
