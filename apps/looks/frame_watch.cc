#include "apps/looks/frame_watch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

constexpr double kGreensDiffer = 0.05;
constexpr double kMostHot = 0.01;
constexpr double kMostEmpty = 0.005;

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

// Share of the samples, in some of the rows, that are brighter than the nearest four of their
// filter by a twentieth of the range and more.
double hot_share(const capture::RawFrame& frame) {
  constexpr double kOfRange = 0.05;
  constexpr int kRows = 7;  // odd: of either filter
  const double by = kOfRange * (frame.white_counts - frame.black_counts[0]);
  std::size_t hot = 0, all = 0;
  for (int y = 2; y + 2 < frame.height_px; y += kRows) {
    for (int x = 2; x + 2 < frame.width_px; ++x) {
      const int around = std::max(
          {frame.at(x - 2, y), frame.at(x + 2, y), frame.at(x, y - 2), frame.at(x, y + 2)});
      hot += frame.at(x, y) > around + by ? 1 : 0;
      ++all;
    }
  }
  return all > 0 ? static_cast<double>(hot) / static_cast<double>(all) : 0.0;
}

// Share of the rows of which every sample is zero, although black is beyond what noise can bring
// down to zero.
double empty_share(const capture::RawFrame& frame) {
  constexpr double kLeastBlack = 8.0;
  const auto width = static_cast<std::size_t>(frame.width_px);
  if (width == 0 ||
      *std::min_element(frame.black_counts.begin(), frame.black_counts.end()) < kLeastBlack) {
    return 0.0;
  }
  int empty = 0;
  for (std::size_t first = 0; first + width <= frame.samples.size(); first += width) {
    const auto row = frame.samples.begin() + static_cast<std::ptrdiff_t>(first);
    empty += std::all_of(row, row + frame.width_px, [](auto v) { return v == 0; }) ? 1 : 0;
  }
  return static_cast<double>(empty) / frame.height_px;
}

}  // namespace

void FrameWatch::look(std::size_t shot_idx, const capture::RawFrame& frame) {
  const Seen seen{std::abs(green_ratio(frame) - 1.0), hot_share(frame), empty_share(frame)};
  const std::lock_guard lock(mutex_);
  seen_[shot_idx] = seen;
}

std::vector<Finding> FrameWatch::findings() const {
  // The shots of which that is more than `most`, and its largest value.
  const auto beyond = [&](double Seen::*of, double most) {
    std::pair<std::vector<std::size_t>, double> out;
    for (const auto& [shot_idx, seen] : seen_) {
      if (!(seen.*of > most)) continue;
      out.first.push_back(shot_idx);
      out.second = std::max(out.second, seen.*of);
    }
    return out;
  };
  const auto first = [&](const std::vector<std::size_t>& shots) {
    return scene_.shots[shots.front()].file;
  };
  std::vector<Finding> out;
  if (const auto& [shots, worst] = beyond(&Seen::empty_share, kMostEmpty); !shots.empty()) {
    out.push_back({"damaged file",
                   fmt::format("damaged file: {:.2g} % of the rows of {} contain nothing but zeros",
                               100.0 * worst, first(shots)),
                   "copy it from the card again, or take the shot again", shots});
  }
  if (const auto& [shots, worst] = beyond(&Seen::greens_differ, kGreensDiffer); !shots.empty()) {
    out.push_back(
        {"colour filters",
         fmt::format("colour filters exchanged: the two green sites of {} differ by {:.0f} %",
                     first(shots), 100.0 * worst),
         "the pattern that the file states is not that of the sensor; use raw files as "
         "the camera wrote them",
         shots});
  }
  if (const auto& [shots, worst] = beyond(&Seen::hot_share, kMostHot); !shots.empty()) {
    out.push_back({"hot pixels",
                   fmt::format("hot pixels: {:.1f} % of the samples of {} are far brighter than "
                               "their neighbours",
                               100.0 * worst, first(shots)),
                   "take shorter exposures with a cooler camera, or list its hot pixels by "
                   "`scattermeter calibrate radiance`",
                   shots});
  }
  return out;
}

}  // namespace scattermeter::apps
