#include "capture/sensor/mended_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace scattermeter::capture {

void mend_defects(const std::vector<std::size_t>& defect_pixels, RawFrame& frame) {
  constexpr int kPeriod = 2;  // of the filters
  const auto width = static_cast<std::size_t>(frame.width_px);
  for (const std::size_t pixel : defect_pixels) {
    if (pixel >= frame.samples.size()) break;
    const auto x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
    double sum = 0.0, n = 0.0;
    for (const auto& [dx, dy] :
         {std::pair(-kPeriod, 0), {kPeriod, 0}, {0, -kPeriod}, {0, kPeriod}}) {
      const int to_x = x + dx, to_y = y + dy;
      if (to_x < 0 || to_y < 0 || to_x >= frame.width_px || to_y >= frame.height_px) continue;
      const std::size_t to =
          static_cast<std::size_t>(to_y) * width + static_cast<std::size_t>(to_x);
      if (std::binary_search(defect_pixels.begin(), defect_pixels.end(), to)) continue;
      sum += frame.samples[to];
      n += 1.0;
    }
    if (n > 0.0) frame.samples[pixel] = static_cast<std::uint16_t>(std::lround(sum / n));
  }
}

}  // namespace scattermeter::capture
