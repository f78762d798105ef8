// What the rigs made in code share: camera, pose marks, lamps.
#pragma once

#include <string>

#include <Eigen/Core>

#include "apps/rig/rig.h"

namespace scattermeter::apps {

// Sets camera, truth pose and pose points: a camera of a D80's noise and frame, at `image_width_px`
// (rounded down to even), that looks down at a body of some 20 mm at the origin. The frame is 3872
// to 2592 and about 71 mm wide at the body whatever the width. The pose points are exact and known
// to 0.001 px; the scale is exact. Precondition (std::invalid_argument): 240 <= image_width_px <=
// 3872.
void set_up_camera(Rig& rig, int image_width_px);

// Width of a pixel on a body at the origin, mm, of a rig that was set up so.
double pixel_mm(const Rig& rig);

// An LED of exponent 1 and some 0.05 W/sr; place, lobe and power are exact.
SceneLight studio_led(const std::string& name, const Eigen::Vector3d& position_mm,
                      const Eigen::Vector3d& towards);

}  // namespace scattermeter::apps
