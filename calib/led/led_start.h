// Initial estimate of an LED's position from its highlights, independent of the rig.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "calib/led/led_scene.h"
#include "core/camera/lens.h"
#include "core/light/led.h"

namespace scattermeter::calib {

// The point where the rays reflected by the mirror spheres towards the LED meet.
struct LedStart {
  Eigen::Vector3d position_mm;
  std::vector<bool> agrees;  // one per highlight of the scene
};

// The point nearest to the reflected rays of the largest set of highlights that agree. The point
// where the rays of each pair of highlights meet is projected back, and a highlight agrees with it
// if its image is within `inlier_px` (or five of its standard deviations) of the prediction. None
// with fewer than two highlights, or if no two rays meet in front of the spheres.
std::optional<LedStart> led_start(const LedScene& scene, double inlier_px);

// The image of the LED in a sphere as seen by the camera, px; NaN if there is none. With a
// radius_mm it is the centre of the image of that disc about the axis: the mean over four points on
// a ring of radius / sqrt 2, exact to second order.
Eigen::Vector2d highlight_px(const Lens& lens, const Rigid3d& camera_from_world,
                             const MirrorSphere& sphere, const Led& led);

}  // namespace scattermeter::calib
