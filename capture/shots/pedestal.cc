#include "capture/shots/pedestal.h"

#include <cmath>
#include <cstddef>

#include "capture/sensor/background_level.h"

namespace scattermeter::capture {
namespace {

// Mean counts above black of each channel. Every 16th pair of rows shows it well enough.
std::array<double, kRgb> mean_counts(const RawFrame& frame) {
  constexpr int kPeriod = 32;
  std::array<double, kRgb> sum{};
  std::array<double, kRgb> n{};
  for (int y = 0; y < frame.height_px; ++y) {
    if (y % kPeriod > 1) continue;
    for (int x = 0; x < frame.width_px; ++x) {
      const auto phase = 2U * (static_cast<unsigned>(y) & 1U) + (static_cast<unsigned>(x) & 1U);
      const auto c = static_cast<std::size_t>(frame.cfa.at(x, y));
      sum[c] += frame.at(x, y) - frame.black_counts[phase];
      n[c] += 1.0;
    }
  }
  for (std::size_t c = 0; c < kRgb; ++c) sum[c] = n[c] > 0.0 ? sum[c] / n[c] : 0.0;
  return sum;
}

}  // namespace

Pedestal pedestal_of(const RawFrame& frame, const PixelRect& object) {
  constexpr std::size_t kLeastBlocks = 8;
  const BackgroundLevel background =
      background_level(frame, object.x0, object.y0, object.width, object.height);
  const std::array<double, kRgb> mean = mean_counts(frame);
  Pedestal out;
  for (std::size_t c = 0; c < kRgb; ++c) {
    if (background.blocks < kLeastBlocks) {
      out.std_counts[c] = std::hypot(1.0, 0.01 * mean[c]);
      continue;
    }
    // The darkest blocks of a uniform background are dark by chance.
    constexpr double kByChance = 3.0;  // deviations of a block
    const double spread = background.median_counts[c] - background.darkest_counts[c];
    const double level = spread < kByChance * background.block_std_counts[c]
                             ? background.median_counts[c]
                             : background.darkest_counts[c];
    const double beside = background.beside_counts[c] - level;
    const double by_chance = kByChance * background.block_std_counts[c] /
                             std::sqrt(static_cast<double>(background.blocks_beside));
    out.beside_counts[c] = background.blocks_beside > 0 && beside > by_chance ? beside : 0.0;
    out.counts[c] = level > 0.0 ? kPedestalShare * level : level;
    const double own = level > 0.0 ? 0.4 * level : 0.0;
    out.std_counts[c] = std::sqrt(own * own + 0.01 + 1e-6 * mean[c] * mean[c] +
                                  background.block_std_counts[c] * background.block_std_counts[c] /
                                      static_cast<double>(background.blocks));
  }
  return out;
}

}  // namespace scattermeter::capture
