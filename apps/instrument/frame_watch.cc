#include "apps/instrument/frame_watch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

constexpr double kGreensDiffer = 0.05;

// Light of the green sites in even rows over that in odd rows, where neither is dark or clipped; 1
// where there are too few of them.
double green_ratio(const capture::RawFrame& frame) {
  constexpr double kDark = 0.05, kBright = 0.95;
  constexpr int kLeastCells = 300;
  std::array<std::size_t, 2> green{};
  for (std::size_t row = 0; row < 2; ++row) {
    green[row] = 2 * row + (frame.cfa.phase[2 * row] == Channel::kGreen ? 0 : 1);
    if (frame.cfa.phase[green[row]] != Channel::kGreen) return 1.0;
  }
  std::array<double, 2> sum{};
  int cells = 0;
  for (int y = 0; y + 1 < frame.height_px; y += 2) {
    for (int x = 0; x + 1 < frame.width_px; x += 2) {
      std::array<double, 2> light{};
      bool is_used = true;
      for (std::size_t row = 0; row < 2; ++row) {
        const double black = frame.black_counts[green[row]];
        const double range = frame.white_counts - black;
        light[row] =
            frame.at(x + static_cast<int>(green[row] % 2), y + static_cast<int>(row)) - black;
        is_used = is_used && light[row] < kBright * range;
      }
      const double range = frame.white_counts - frame.black_counts[green[0]];
      if (!is_used || !(light[0] + light[1] > 2.0 * kDark * range)) continue;
      sum[0] += light[0];
      sum[1] += light[1];
      ++cells;
    }
  }
  return cells >= kLeastCells ? sum[0] / sum[1] : 1.0;
}

}  // namespace

void FrameWatch::look(std::size_t shot_idx, const capture::RawFrame& frame) {
  const double ratio = green_ratio(frame);
  const std::lock_guard lock(mutex_);
  green_ratio_[shot_idx] = ratio;
}

std::vector<Finding> FrameWatch::findings() const {
  Finding finding;
  double worst = 0.0;
  for (const auto& [shot_idx, ratio] : green_ratio_) {
    const double off = std::abs(ratio - 1.0);
    if (!(off > kGreensDiffer)) continue;
    worst = std::max(worst, off);
    finding.shots.push_back(shot_idx);
  }
  if (finding.shots.empty()) return {};
  finding.cause = "colour filters";
  finding.text =
      fmt::format("colour filters exchanged: the two green sites of {} differ by {:.0f} %",
                  scene_.shots[finding.shots.front()].file, 100.0 * worst);
  finding.advice =
      "the pattern that the file states is not that of the sensor; use raw files as "
      "the camera wrote them";
  return {finding};
}

}  // namespace scattermeter::apps
