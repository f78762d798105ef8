// The position of the image of a mirror sphere in a frame.
#pragma once

#include <Eigen/Core>

#include "calib/led/mirror_sphere.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Rectangle (even x0, y0; clipped to the frame) around the image of a sphere with a margin of some
// px; empty (width 0) if it is out of view.
struct SphereImage {
  int x0 = 0, y0 = 0, width = 0, height = 0;            // px
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  // of the sphere's centre
  double radius_px = 0;  // from there to the nearest point of the outline
};
SphereImage sphere_image(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                         const MirrorSphere& sphere);

}  // namespace scattermeter::calib
