// Camera pose from the outline of a known body in one or several shots.
#pragma once

#include <string>
#include <vector>

#include "calib/pose/edge_points.h"
#include "core/camera/camera_model.h"
#include "core/camera/pixel_rect.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

struct SilhouetteOptions {
  // Search range for the outline to each side of its predicted position, as a share of the frame
  // width: 0.06 corresponds to 1.4 degrees with a field of view of 23 degrees. In (0, 0.2].
  double search = 0.06;
  // Least standard deviation, px, of the errors of mesh, lens and edge profile that are common to a
  // straight edge; replaced by that of the residuals if larger. >= 0.
  double line_std_px = 0.1;
  // Parts of the shots may be masked (CfaSamples::clipped): a level of step (2) other than the last
  // may find too few pieces.
  bool may_lack_parts = false;
  // The pose is correct to a few px, and parts of the shots may be masked (CfaSamples::clipped):
  // the coarse search, step (1), is omitted, and a level of step (2) other than the last may find
  // too few pieces. Pieces more than 8 px and a cell away are not taken for the outline.
  bool pose_is_near = false;
  void Check() const;  // std::invalid_argument naming the field
};

// Each status with its condition, in the order in which they are checked.
enum class SilhouetteStatus {
  kOk,
  // The contrast across the outline is highest at an end of the search, or no higher than by
  // chance.
  kNotFound,
  // Fewer than three straight edges or ten pieces of them were found.
  kTooFewPieces,
  // The pose is uncertain by more than 0.05 rad or 0.05 of its distance, or did not converge.
  kIllConditioned,
};

struct Silhouette {
  SilhouetteStatus status = SilhouetteStatus::kNotFound;
  std::string message;  // "" if ok
  // The members below are valid only if ok.
  Rigid3d camera_from_world;        // best match of the outlines of mesh and shots alone
  std::vector<EdgePoint> points;    // without outliers; offset_px: relative to the given pose
  std::size_t pieces_left_out = 0;  // located, but off their line or off all others
  // Excess scatter about the best fit over the noise, px: of lines, and of single pieces.
  double line_std_px = 0;
  double piece_std_px = 0;
};

// The part of the frame that find_silhouette() needs, px.
PixelRect silhouette_window(const RayScene& scene, const CameraIntrinsics& intrinsics,
                            const Rigid3d& camera_from_world, const SilhouetteOptions& options);

// Pose of a camera that does not move, from all shots. (1) On coarse cells, turn_coarsely() finds
// the rotation of the camera, as a shift of the image, with the highest contrast (inside - outside)
// / (inside + outside) over all contours. (2) From these cells down to the raw samples, halving the
// cell size each time, pieces are located (edge_points()) and the pose is fitted by least squares
// with Cauchy's loss, so that clutter and unlit edges have little influence; pieces that are alone
// on their line are dropped. (3) Pieces off by more than six robust standard deviations are left
// out, and the scatter of pieces about their line and of lines about the pose is estimated by
// moments (R. C. Paule, J. Mandel, "Consensus values and weighting factors", 1982). Deterministic.
// Throws std::invalid_argument without shots and for options out of range.
Silhouette find_silhouette(const std::vector<EdgeShot>& shots, const CameraIntrinsics& intrinsics,
                           const Rigid3d& camera_from_world, const SilhouetteOptions& options = {});

}  // namespace scattermeter::calib
