// The contour of any body before its background, as points on the mesh.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter::calib {

struct ContourPoint {
  Eigen::Vector3d point_mm;  // where the line of sight grazes the mesh, world
  Eigen::Vector2d at_px;     // its image
  Eigen::Vector2d outward;   // unit, in the image, away from the body
};

// Points about one cell of `cell_px` apart along the outer contour of the body as seen from the
// pose, without its corners. Round bodies and scanned meshes have as many as bodies with straight
// edges. Rays through the centres of cells find the contour, and bisection puts each point within
// 1/50 of a cell. Empty for a body without an image. Precondition: cell_px > 0.
std::vector<ContourPoint> contour_points(const RayScene& scene, const CameraIntrinsics& intrinsics,
                                         const Rigid3d& camera_from_world, int cell_px);

}  // namespace scattermeter::calib
