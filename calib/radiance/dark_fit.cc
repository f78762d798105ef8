#include "calib/radiance/dark_fit.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "calib/radiance/frame_blocks.h"
#include "core/base/median.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::calib {
namespace {

std::size_t phase_of(std::size_t i, std::size_t width) {
  return cfa_phase(static_cast<int>(i % width), static_cast<int>(i / width));
}

}  // namespace

DarkFrame dark_frame(std::span<const std::uint16_t> samples, std::span<const std::uint8_t> marks,
                     int width_px, double exposure_s) {
  const auto width = static_cast<std::size_t>(width_px);
  if (samples.size() != marks.size() || width_px < 1) {
    throw std::invalid_argument("dark_frame: " + std::to_string(samples.size()) + " samples and " +
                                std::to_string(marks.size()) + " marks");
  }
  DarkFrame out;
  out.exposure_s = exposure_s;
  std::array<std::vector<float>, 4> values;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (marks[i] == 0) values[phase_of(i, width)].push_back(static_cast<float>(samples[i]));
  }
  for (std::size_t p = 0; p < 4; ++p) {
    if (values[p].size() < 2) continue;
    const float middle = upper_median(values[p]);
    const double median = static_cast<double>(middle);
    const double reach = std::max(
        8.0, 8.0 * kStdPerMad * static_cast<double>(median_absolute_deviation(values[p], middle)));
    double sum = 0, squares = 0, n = 0;
    for (const float v : values[p]) {
      const double d = static_cast<double>(v) - median;
      if (std::abs(d) > reach) continue;
      sum += d;
      squares += d * d;
      n += 1.0;
    }
    if (n < 2.0) continue;
    out.mean_counts[p] = median + sum / n;
    out.std_of_mean[p] = std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1.0) / n);
  }
  return out;
}

DarkFit fit_dark(const std::vector<DarkFrame>& frames) {
  if (frames.empty()) throw std::invalid_argument("fit_dark: no frames");
  DarkFit out;
  const auto n = static_cast<double>(frames.size());
  double t_mean = 0, t_min = frames[0].exposure_s, t_max = t_min;
  for (const DarkFrame& f : frames) {
    t_mean += f.exposure_s / n;
    t_min = std::min(t_min, f.exposure_s);
    t_max = std::max(t_max, f.exposure_s);
  }
  out.rate_known = t_max >= 2.0 * t_min;
  double t_squares = 0;
  for (const DarkFrame& f : frames) t_squares += (f.exposure_s - t_mean) * (f.exposure_s - t_mean);
  std::array<double, 4> mean{};
  for (std::size_t p = 0; p < 4; ++p) {
    double product = 0;
    for (const DarkFrame& f : frames) {
      mean[p] += f.mean_counts[p] / n;
      product += (f.exposure_s - t_mean) * f.mean_counts[p];
    }
    if (out.rate_known) out.dark_counts_per_s[p] = product / t_squares;
    out.black_counts[p] = mean[p] - out.dark_counts_per_s[p] * t_mean;
  }
  double squares = 0, own = 0;
  for (const DarkFrame& f : frames) {
    double residual = 0, variance = 0;
    for (std::size_t p = 0; p < 4; ++p) {
      residual +=
          0.25 * (f.mean_counts[p] - out.black_counts[p] - out.dark_counts_per_s[p] * f.exposure_s);
      variance += 0.0625 * f.std_of_mean[p] * f.std_of_mean[p];
    }
    out.residual_counts.push_back(residual);
    squares += residual * residual;
    own += variance / n;
    out.worst_counts = std::max(out.worst_counts, std::abs(residual));
  }
  out.rms_counts = std::sqrt(squares / n);
  const double parameters = out.rate_known ? 2.0 : 1.0;
  out.scatter_known = n >= parameters + 2.0;
  double frame_variance = own;
  if (out.scatter_known) frame_variance = std::max(own, squares / (n - parameters));
  // The error of the fit is largest at the ends of the range of exposures; a new frame adds its own
  // scatter.
  double fit_share = 1.0 / n;
  if (out.rate_known) {
    const double far = std::max(t_max - t_mean, t_mean - t_min);
    fit_share += far * far / t_squares;
  }
  const double scatter = std::max(0.0, frame_variance - own);
  out.black_std_counts = std::sqrt(scatter + frame_variance * fit_share);
  return out;
}

std::vector<std::size_t> hot_pixels(std::span<const float> sums, int n_frames, int width_px,
                                    double std_counts, double min_counts) {
  if (n_frames < 1 || width_px < 1) throw std::invalid_argument("hot_pixels: no frames");
  const auto width = static_cast<std::size_t>(width_px);
  std::array<std::vector<float>, 4> values;
  for (std::size_t i = 0; i < sums.size(); ++i) values[phase_of(i, width)].push_back(sums[i]);
  std::array<double, 4> limit{};
  for (std::size_t p = 0; p < 4; ++p) {
    if (values[p].empty()) continue;
    limit[p] = static_cast<double>(upper_median(std::move(values[p]))) +
               n_frames * std::max(min_counts, 6.0 * std_counts / std::sqrt(n_frames));
  }
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (static_cast<double>(sums[i]) > limit[phase_of(i, width)]) out.push_back(i);
  }
  return out;
}

Unevenness unevenness(std::span<const std::uint16_t> samples, std::span<const std::uint8_t> marks,
                      int width_px) {
  const auto height_px = static_cast<int>(samples.size() / static_cast<std::size_t>(width_px));
  const int columns = std::clamp(width_px / 8, 1, 8);
  const int rows = std::clamp(height_px / 8, 1, 8);
  const DarkFrame whole = dark_frame(samples, marks, width_px, 0.0);
  const std::vector<Block> blocks = blocks_of_frame(width_px, height_px, columns, rows);
  Unevenness out;
  double of_frame = 0.25 * static_cast<double>(samples.size());
  for (std::size_t b = 0; b < blocks.size(); b += 4) {
    double sum = 0, variance = 0;
    int phases = 0;
    for (std::size_t p = 0; p < 4; ++p) {
      const Block& block = blocks[b + p];
      // The median of the means of rows, to exclude single bright pixels.
      std::vector<float> values;
      for (int y = block.y0; y < block.y1; y += 2) {
        for (int x = block.x0; x < block.x1; x += 2) {
          const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                                static_cast<std::size_t>(x);
          if (marks[i] == 0) values.push_back(static_cast<float>(samples[i]));
        }
      }
      if (values.size() < 4) continue;
      std::sort(values.begin(), values.end());
      const std::size_t cut = values.size() / 8;  // a trimmed mean
      double mean = 0;
      for (std::size_t i = cut; i < values.size() - cut; ++i)
        mean += static_cast<double>(values[i]);
      mean /= static_cast<double>(values.size() - 2 * cut);
      sum += mean - whole.mean_counts[p];
      const double s = whole.std_of_mean[p];
      variance += s * s * of_frame / static_cast<double>(values.size());
      ++phases;
    }
    if (phases == 0) continue;
    out.counts = std::max(out.counts, std::abs(sum / phases));
    out.std = std::max(out.std, std::sqrt(variance) / phases);
  }
  return out;
}

}  // namespace scattermeter::calib
