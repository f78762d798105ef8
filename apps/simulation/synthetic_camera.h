// The camera, pose marks and LEDs that the rigs made in code share.
#pragma once

#include <string>

#include <Eigen/Core>

#include "apps/rig/rig.h"

namespace scattermeter::apps {

// Sets the camera, its true pose and the pose points: a camera with the noise and aspect ratio
// (3872 : 2592) of a Nikon D80, `image_width_px` (rounded down to even) wide, that looks down at a
// body of about 20 mm at the origin. At the body the frame is about 71 mm wide for any width in px.
// The pose points are exact and known to 0.001 px; the scale is exact. Throws std::invalid_argument
// unless 240 <= image_width_px <= 3872.
void set_up_camera(Rig& rig, int image_width_px);

// Width of a pixel at the origin, mm, for a rig that was set up by set_up_camera().
double pixel_mm(const Rig& rig);

// An LED of exponent 1 and about 0.05 W/sr; position, lobe and power are exactly known.
SceneLight synthetic_led(const std::string& name, const Eigen::Vector3d& position_mm,
                         const Eigen::Vector3d& towards);

}  // namespace scattermeter::apps
