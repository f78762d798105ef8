// Where a piece stands, from its outline in shots of a camera whose pose is known.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "calib/pose/silhouette.h"
#include "core/camera/camera_model.h"
#include "core/camera/camera_pose.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// Shots from one pose of the camera. Their meshes stand where the piece is stated to.
struct PieceView {
  PoseResult camera;
  std::vector<EdgeShot> shots;
};

struct PiecePoseOptions {
  SilhouetteOptions silhouette = {.search = 0.2};
  // Where the outline is not found from the stated position, it is searched for from six others, 4
  // degrees about the piece's axes.
  bool may_be_turned = true;
  // Of all lengths of the mesh: a piece that is larger looks like one that is nearer.
  double scale_relative_std = 0;
  // The piece stands on a plane as stated: it is displaced along the world's x and y and turned
  // about z only, but for `plane_std_mm` in height, at a distance of size_mm for the tilt.
  bool is_on_plane = false;
  double plane_std_mm = 0.03;
  double size_mm = 20;
};

struct PiecePose {
  std::string problem;  // why it was not found; "" if it was
  Rigid3d moved;        // from the stated position to that found, both in the world
  // The same: (displacement of the piece's centre, mm; turn about it, rad), in world axes.
  Eigen::Matrix<double, 6, 1> off = Eigen::Matrix<double, 6, 1>::Zero();
  // Of the same from the position found to the true one.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// A motion of the piece in the world, followed by a displacement of its centre, mm, and a turn
// about it, rad, as PiecePose::off. center_mm: before the motion.
Rigid3d followed_by(const Rigid3d& motion, const Eigen::Matrix<double, 6, 1>& step,
                    const Eigen::Vector3d& center_mm);

// The silhouettes of each view (find_silhouette()) give the piece's pose relative to the camera;
// with the camera's own pose, its pose in the world. Views are combined by their information,
// without those in which no outline is found, and a plane by that of its height and tilt.
// center_mm: of the piece as stated, world. A problem is reported where no view shows an outline,
// where views contradict each other, or a piece its plane (p below 1e-6). A body that looks the
// same after a turn is found in the position next to the stated one. Throws std::invalid_argument
// without views and for options out of range.
PiecePose find_piece(const std::vector<PieceView>& views, const CameraIntrinsics& intrinsics,
                     const Eigen::Vector3d& center_mm, const PiecePoseOptions& options = {});

}  // namespace scattermeter::calib
