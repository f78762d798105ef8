// The pixels that show a white plane.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "calib/led/white_plane.h"
#include "core/view/camera_view.h"

namespace scattermeter::calib {

struct WhitePixel {
  std::size_t pixel;         // y * width_px + x
  Eigen::Vector3d point_mm;  // where the ray of its centre meets the plane
};

// The pixels whose ray meets the white side of the plane at least margin_mm inside its edges
// (negative: at most that far outside).
std::vector<WhitePixel> white_pixels(const WhitePlane& plane, const CameraView& view,
                                     double margin_mm);

}  // namespace scattermeter::calib
