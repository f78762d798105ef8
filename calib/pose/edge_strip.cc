#include "calib/pose/edge_strip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Cholesky>

#include "calib/pose/strip_fit.h"

namespace scattermeter::calib {
namespace {

constexpr double kMinBlur = 0.02;  // px; the box of the pixel is several times wider

// Samples of the strip; empty if it leaves the picture or contains a clipped sample.
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
      // Half open, so that strips placed end to end have no sample in common.
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

struct EdgeEstimate {
  double offset = 0, blur = 0;  // px
};

// The best point of a grid, as the cost has several minima if shading or noise is strong; none if
// no cost is finite.
std::optional<EdgeEstimate> best_of_grid(StripFit& fit, const EdgeStripOptions& options) {
  double best = std::numeric_limits<double>::infinity();
  EdgeEstimate at{0, options.blur_px.value_or(0.5)};
  const int steps = std::max(1, static_cast<int>(std::ceil(2 * options.search_px)));
  const std::vector<double> blurs =
      options.blur_px ? std::vector{*options.blur_px} : std::vector{0.3, 1.0};
  for (const double b : blurs) {
    for (int i = -steps; i <= steps; ++i) {
      const double o = options.search_px * i / steps;
      const double chi2 = fit.solve(o, b);
      if (chi2 < best) {
        best = chi2;
        at = {o, b};
      }
    }
  }
  if (!std::isfinite(best)) return std::nullopt;
  return at;
}

// Gauss-Newton iteration from `at`, with steps halved if they do not reduce the cost and weights
// updated in the first steps. False if a step is not finite. `blur_is_bound`: the last step led to
// a blur beyond its range.
bool refine_edge(StripFit& fit, const EdgeStripOptions& options, EdgeEstimate& at,
                 bool& blur_is_bound) {
  blur_is_bound = false;
  double chi2 = fit.solve(at.offset, at.blur);
  for (int iteration = 0; iteration < 25; ++iteration) {
    if (iteration < 4) {
      fit.reweigh();
      chi2 = fit.solve(at.offset, at.blur);
    }
    Eigen::Vector2d gradient;
    const Eigen::Matrix2d info = fit.information(&gradient);
    blur_is_bound = (at.blur <= kMinBlur && gradient[1] < 0) ||
                    (at.blur >= options.max_blur_px && gradient[1] > 0);
    Eigen::Vector2d step(gradient[0] / info(0, 0), 0);
    if (!blur_is_bound) step = info.ldlt().solve(gradient);
    if (!step.allFinite()) return false;
    double share = 1;
    bool gained = false;
    for (int halving = 0; halving < 8 && !gained; ++halving, share *= 0.5) {
      const double o = at.offset + std::clamp(share * step[0], -0.5, 0.5);
      const double b = options.blur_px.value_or(std::clamp(
          at.blur + std::clamp(share * step[1], -0.4, 0.4), kMinBlur, options.max_blur_px));
      const double chi2_there = fit.solve(o, b);
      if (chi2_there <= chi2 + 1e-9) {
        gained = true;
        chi2 = chi2_there;
        const double moved = std::abs(o - at.offset);
        at = {o, b};
        if (iteration >= 4 && moved < 1e-5) return true;
      }
    }
    if (!gained && iteration >= 4) break;
    if (!gained) chi2 = fit.solve(at.offset, at.blur);
  }
  return true;
}

}  // namespace

EdgeStrip locate_edge(const CfaSamples& samples, const Eigen::Vector2d& at_px,
                      const Eigen::Vector2d& outward, const EdgeStripOptions& options) {
  if (!(std::abs(outward.norm() - 1) < 1e-6) || !at_px.allFinite()) {
    throw std::invalid_argument("locate_edge: outward must be a unit vector, at_px finite");
  }
  EdgeStrip out;
  StripFit fit(samples_in(samples, at_px, outward, options), outward, samples.variance_per_count,
               options.both_bright);
  if (fit.samples() < fit.unknowns() + 10) return out;
  std::optional<EdgeEstimate> at = best_of_grid(fit, options);
  bool blur_is_bound = false;
  if (!at || !refine_edge(fit, options, *at, blur_is_bound)) return out;
  const double chi2 = fit.solve(at->offset, at->blur);
  Eigen::Vector2d gradient;
  const Eigen::Matrix2d info = fit.information(&gradient);
  // With the blur eliminated.
  const double left = blur_is_bound || at->blur <= kMinBlur
                          ? info(0, 0)
                          : info(0, 0) - info(0, 1) * info(0, 1) / info(1, 1);
  const double variance = 1.0 / left;
  double sign = 0;
  out.snr = fit.snr(&sign);
  out.offset_px = at->offset;
  out.blur_px = at->blur;
  out.reduced_chi2 = chi2 / (fit.samples() - fit.unknowns());
  out.std_px = std::sqrt(variance * std::max(1.0, out.reduced_chi2));
  out.found = std::isfinite(out.std_px) && variance > 0 && out.snr >= options.min_snr &&
              (options.both_bright || sign > 0) && std::abs(out.offset_px) <= options.search_px;
  return out;
}

}  // namespace scattermeter::calib
