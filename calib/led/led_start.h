// A first estimate of an LED's position from its highlights, whatever the rig says.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "core/camera/lens.h"
#include "core/light/led.h"

namespace scattermeter::calib {

// Where the rays meet that the mirror spheres send towards the LED.
struct LedStart {
  Eigen::Vector3d position_mm;
  std::vector<bool> agrees;  // one per highlight of the scene
};

// The point nearest to the mirrored rays of the largest set of highlights that agree: of every pair
// of highlights the meeting point is projected back, and a highlight agrees whose image then lies
// within `inlier_px` (or five of its deviations). None with fewer than two highlights, or where no
// two rays meet before the spheres.
std::optional<LedStart> led_start(const LedScene& scene, double inlier_px);

// The LED's image in a sphere as the camera shows it, px; NaN where there is none. With a radius_mm
// the middle of the image of that disc about the axis: the mean over four points on a ring of
// radius / sqrt 2, exact to the second order.
Eigen::Vector2d highlight_px(const Lens& lens, const Rigid3d& camera_from_world,
                             const MirrorSphere& sphere, const Led& led);

}  // namespace scattermeter::calib
