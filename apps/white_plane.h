// A white reference as the camera sees it.
#pragma once

#include <cstddef>
#include <vector>

#include "apps/camera_view.h"
#include "apps/rig_radiance_calibration.h"
#include "core/led.h"

namespace scattermeter::apps {

struct WhitePixel {
  std::size_t pixel;         // y * width_px + x
  Eigen::Vector3d point_mm;  // where its centre's ray meets the plane
};

// The pixels whose ray meets the white side of the plane at least margin_mm inside its edges (below
// 0: outside).
std::vector<WhitePixel> white_pixels(const RigWhite& white, const CameraView& view,
                                     double margin_mm);

Eigen::Vector3d white_normal(const RigWhite& white);

}  // namespace scattermeter::apps
