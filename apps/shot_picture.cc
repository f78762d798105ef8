#include "apps/shot_picture.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/saturation.h"

namespace scattermeter::apps {

Picture shot_picture(const capture::RawFrame& frame, const SampleMap& map, int width_px) {
  const int margin = std::max(map.width, map.height) / 10;
  // Whole 2 x 2 cells.
  const int x0 = std::max(0, map.x0 - margin) / 2 * 2;
  const int y0 = std::max(0, map.y0 - margin) / 2 * 2;
  const int x1 = std::min(frame.width_px, map.x0 + map.width + margin);
  const int y1 = std::min(frame.height_px, map.y0 + map.height + margin);
  const int step = std::max(2, ((x1 - x0) / width_px + 1) / 2 * 2 + 2);
  Picture out(std::max(1, (x1 - x0) / step), std::max(1, (y1 - y0) / step), {0, 0, 0});
  const std::array<double, 4> clip = capture::clip_levels(frame);
  const auto in_use = [&](int x, int y) {
    if (x < map.x0 || y < map.y0 || x >= map.x0 + map.width || y >= map.y0 + map.height) {
      return false;
    }
    return map.row_of_sample[static_cast<std::size_t>(y - map.y0) *
                                 static_cast<std::size_t>(map.width) +
                             static_cast<std::size_t>(x - map.x0)] >= 0;
  };
  std::vector<double> light(static_cast<std::size_t>(out.width_px) *
                            static_cast<std::size_t>(out.height_px));
  std::vector<bool> clipped(light.size());
  for (int y = 0; y < out.height_px; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width_px) +
                     static_cast<std::size_t>(x);
      int n = 0;
      for (int v = y0 + y * step; v < std::min(y0 + (y + 1) * step, y1); ++v) {
        for (int u = x0 + x * step; u < std::min(x0 + (x + 1) * step, x1); ++u, ++n) {
          const std::size_t phase = cfa_phase(u, v);
          light[i] += frame.at(u, v) - frame.black_counts[phase];
          clipped[i] = clipped[i] || frame.at(u, v) >= clip[phase];
        }
      }
      light[i] /= std::max(n, 1);
    }
  }
  const double white = std::max(1.0, *std::max_element(light.begin(), light.end()));
  for (int y = 0; y < out.height_px; ++y) {
    for (int x = 0; x < out.width_px; ++x) {
      const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width_px) +
                     static_cast<std::size_t>(x);
      const int u = x0 + x * step + step / 2;
      const int v = y0 + y * step + step / 2;
      const bool edge = in_use(u, v) != in_use(u + step, v) || in_use(u, v) != in_use(u, v + step);
      out.set(x, y,
              clipped[i] ? kClippedColour
              : edge     ? kOutlineColour
                         : grey_colour(light[i] / white));
    }
  }
  return out;
}

}  // namespace scattermeter::apps
