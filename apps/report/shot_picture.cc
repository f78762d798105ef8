#include "apps/report/shot_picture.h"

#include <array>
#include <vector>

#include "capture/sensor/saturation.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::apps {
namespace {

constexpr std::size_t kMostDots = 2000;

std::vector<OverlayDot> clipped_dots(const capture::RawFrame& frame, const SampleMap& map) {
  const std::array<double, 4> clip = capture::clip_levels(frame);
  std::vector<OverlayDot> all;
  for (int y = map.y0; y < map.y0 + map.height; ++y) {
    for (int x = map.x0; x < map.x0 + map.width; ++x) {
      if (frame.at(x, y) < clip[cfa_phase(x, y)]) continue;
      all.push_back({{x, y}, kClippedColour, 1.5});
    }
  }
  if (all.size() <= kMostDots) return all;
  std::vector<OverlayDot> some;
  for (std::size_t i = 0; i < kMostDots; ++i) some.push_back(all[i * all.size() / kMostDots]);
  return some;
}

}  // namespace

std::string shot_picture(const capture::RawFrame& frame, const CameraView& view,
                         const RayScene& scene, const SampleMap& map, int width_px) {
  const std::vector<OverlayLine> lines = edge_lines(view, scene);
  OverlayOptions options;
  options.crop = crop_around(lines, frame.width_px, frame.height_px);
  options.max_width_px = width_px;
  const std::vector<std::uint8_t> png =
      overlay_png(frame, lines, clipped_dots(frame, map), options);
  return {png.begin(), png.end()};
}

std::string shot_thumbnail(const capture::RawFrame& frame, const CameraView& view,
                           const RayScene& scene, const SampleMap& map) {
  constexpr int kWidth_px = 420;
  return shot_picture(frame, view, scene, map, kWidth_px);
}

}  // namespace scattermeter::apps
