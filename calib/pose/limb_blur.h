// Blur of the outline of a body without edges.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "calib/pose/edge_points.h"
#include "core/camera/camera_model.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// As edge_blur_px2(), of a smooth body without edges. Its light dies off towards the limb, as less
// and less of it passes towards the camera (Ft); what such a limb looks like to locate_edge() when
// blurred by known amounts tells the amount. The contour is taken as straight over 6 px. nullopt
// where fewer than 8 pieces of it are found.
std::optional<Eigen::Matrix2d> limb_blur_px2(const EdgeShot& shot,
                                             const CameraIntrinsics& intrinsics,
                                             const Rigid3d& camera_from_world,
                                             double eta_int_over_ext);

}  // namespace scattermeter::calib
