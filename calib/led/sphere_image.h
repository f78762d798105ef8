// Where the image of a mirror sphere lies in a frame.
#pragma once

#include <Eigen/Core>

#include "calib/led/mirror_sphere.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Rectangle (even x0, y0; cut to the frame) around the image of a sphere with a margin of some px;
// empty (width 0) where it is out of view.
struct SphereImage {
  int x0 = 0, y0 = 0, width = 0, height = 0;            // px
  Eigen::Vector2d center_px = Eigen::Vector2d::Zero();  // of the sphere's centre
  double radius_px = 0;                                 // from there to the nearest of the outline
};
SphereImage sphere_image(const CameraIntrinsics& intrinsics, const Rigid3d& camera_from_world,
                         const MirrorSphere& sphere);

}  // namespace scattermeter::calib
