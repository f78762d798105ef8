#include "capture/sensor/background_level.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace scattermeter::capture {
namespace {

struct BlockSum {
  double n = 0, sum = 0, squares = 0;
};

// The quantile of the values for the given share; reorders the list.
double quantile(std::vector<double>& values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

}  // namespace

BackgroundLevel background_level(const RawFrame& frame, int x0, int y0, int width, int height) {
  if (frame.samples.size() !=
      static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px)) {
    throw std::invalid_argument("background_level: the frame has no samples");
  }
  BackgroundLevel out;
  out.block_px = std::max(16, frame.width_px / 40 / 2 * 2);
  std::array<std::vector<double>, kChannels> means;
  std::array<std::vector<double>, kChannels> stds;
  for (int top = 0; top + out.block_px <= frame.height_px; top += out.block_px) {
    for (int left = 0; left + out.block_px <= frame.width_px; left += out.block_px) {
      // Of the rectangle, enlarged by `by` on each side.
      const auto is_clear = [&](int by) {
        return left + out.block_px <= x0 - by || left >= x0 + width + by ||
               top + out.block_px <= y0 - by || top >= y0 + height + by;
      };
      if (!is_clear(0)) continue;
      const bool is_beside = !is_clear(out.block_px);
      std::array<BlockSum, kChannels> sums;
      for (int y = top; y < top + out.block_px; ++y) {
        for (int x = left; x < left + out.block_px; ++x) {
          const auto phase = 2U * (static_cast<unsigned>(y) & 1U) + (static_cast<unsigned>(x) & 1U);
          BlockSum& s = sums[static_cast<std::size_t>(frame.cfa.at(x, y))];
          const double counts = frame.at(x, y) - frame.black_counts[phase];
          s.n += 1.0;
          s.sum += counts;
          s.squares += counts * counts;
        }
      }
      ++out.blocks;
      if (is_beside) ++out.blocks_beside;
      for (std::size_t c = 0; c < kChannels; ++c) {
        const BlockSum& s = sums[c];
        const double mean = s.sum / s.n;
        means[c].push_back(mean);
        if (is_beside) out.beside_counts[c] += mean;
        stds[c].push_back(std::sqrt(std::max(0.0, s.squares / s.n - mean * mean) / s.n));
      }
    }
  }
  if (out.blocks == 0) return out;
  for (std::size_t c = 0; c < kChannels; ++c) {
    if (out.blocks_beside > 0) out.beside_counts[c] /= static_cast<double>(out.blocks_beside);
    out.darkest_counts[c] = quantile(means[c], 0.1);
    out.median_counts[c] = quantile(means[c], 0.5);
    out.block_std_counts[c] = quantile(stds[c], 0.5);
  }
  return out;
}

}  // namespace scattermeter::capture
