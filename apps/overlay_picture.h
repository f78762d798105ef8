// A shot with lines and dots drawn over it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/camera_view.h"
#include "capture/raw_frame.h"
#include "core/image_rect.h"
#include "core/ray_scene.h"

namespace scattermeter::apps {

using Rgb8 = std::array<std::uint8_t, 3>;

// In pixels of the shot, (0, 0) the centre of the first sample.
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

// The mesh's visible edges as the view shows them; lines that leave the lens's domain are left out.
std::vector<OverlayLine> edge_lines(const CameraView& view, const RayScene& scene,
                                    const OverlayColours& colours = {});

struct OverlayOptions {
  ImageRect crop = {0, 0, 0, 0};  // part of the shot, px; empty: all of it
  int max_width_px = 1280;        // of the picture: a larger shot is made smaller, a small one
                                  // larger by a whole number, at most 8
  double gamma = 2.2;             // grey = (counts / 99.9 % quantile)^(1 / gamma)
};

// Grey picture of the shot (mean of each 2 x 2 cell above black) with lines, then dots over it, as
// the bytes of a PNG: to be written, or put into a page.
std::vector<std::uint8_t> overlay_png(const capture::RawFrame& frame,
                                      const std::vector<OverlayLine>& lines,
                                      const std::vector<OverlayDot>& dots = {},
                                      const OverlayOptions& options = {});

// Around what the lines show, with a tenth of that on each side: for OverlayOptions::crop.
ImageRect crop_around(const std::vector<OverlayLine>& lines, int width_px, int height_px);

// Writes the bytes; the file appears complete or not at all. Throws InputError naming it.
void write_png(const std::vector<std::uint8_t>& png, const std::string& path);

}  // namespace scattermeter::apps
