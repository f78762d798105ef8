// Pictures of a shot with lines and dots drawn over it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "capture/raw/raw_frame.h"
#include "core/light/image_rect.h"
#include "core/mesh/ray_scene.h"
#include "core/view/camera_view.h"

namespace scattermeter::apps {

using Rgb8 = std::array<std::uint8_t, 3>;

// In pixels of the shot; (0, 0) is the centre of the first sample.
struct OverlayLine {
  Eigen::Vector2d from_px;
  Eigen::Vector2d to_px;
  Rgb8 colour;
  double width_px = 1;  // of the picture
};
struct OverlayDot {
  Eigen::Vector2d at_px;
  Rgb8 colour;
  double radius_px = 1.5;  // of the picture
};

struct OverlayColours {
  Rgb8 contour = {255, 160, 0};
  Rgb8 step = {255, 90, 160};
  Rgb8 crease = {0, 200, 255};
};

// The visible edges of the mesh as projected by the view, without lines that leave the domain of
// the lens.
std::vector<OverlayLine> edge_lines(const CameraView& view, const RayScene& scene,
                                    const OverlayColours& colours = {});

struct OverlayOptions {
  ImageRect crop = {0, 0, 0, 0};  // part of the shot, px; empty: all of it
  int max_width_px = 1280;        // of the picture: a larger shot is reduced, a smaller one is
                                  // enlarged by an integer factor of at most 8
  double gamma = 2.2;             // grey = (counts / 99.9 % quantile)^(1 / gamma)
};

// The bytes of a PNG: a grey picture of the shot (mean of each 2 x 2 cell above black) with lines
// and then dots drawn over it.
std::vector<std::uint8_t> overlay_png(const capture::RawFrame& frame,
                                      const std::vector<OverlayLine>& lines,
                                      const std::vector<OverlayDot>& dots = {},
                                      const OverlayOptions& options = {});

// The bounding box of the lines with a margin of a tenth on each side, for OverlayOptions::crop.
ImageRect crop_around(const std::vector<OverlayLine>& lines, int width_px, int height_px);

}  // namespace scattermeter::apps
