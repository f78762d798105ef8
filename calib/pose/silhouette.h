// The camera's pose from the outline of a known body in one or several shots.
#pragma once

#include <string>
#include <vector>

#include "calib/pose/edge_points.h"
#include "core/camera/camera_model.h"
#include "core/camera/pixel_rect.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

struct SilhouetteOptions {
  // The outline is looked for within this part of the frame's width of where the pose has it, in
  // each direction: 0.06 are 1.4 degrees of a camera that sees 23 degrees. In (0, 0.2].
  double search = 0.06;
  // At least this is what mesh, lens and profile depart from the truth, common to a straight edge,
  // standard deviation, px. A larger one found in the residuals takes its place. >= 0.
  double line_std_px = 0.1;
  // The pose is right to a few px, and parts of the shots may be masked (CfaSamples::clipped): the
  // coarse turn, step (1), is left out, and so is a level of step (2) that finds too little but for
  // the last. Pieces more than 8 px and a cell away are not of the outline.
  bool pose_is_near = false;
  void Check() const;  // std::invalid_argument naming the field
};

// Each by its condition, in the order in which they are looked for.
enum class SilhouetteStatus {
  kOk,
  // The contrast across the outline is best at an end of the search, or no better than by chance.
  kNotFound,
  // Fewer than three straight edges or ten pieces of them were found.
  kTooFewPieces,
  // The pose is uncertain by more than 0.05 rad or 0.05 of its distance, or did not settle.
  kIllConditioned,
};

struct Silhouette {
  SilhouetteStatus status = SilhouetteStatus::kNotFound;
  std::string message;  // "" if ok
  // From here on only where ok.
  Rigid3d camera_from_world;  // that puts the mesh's outline best on the shots', nothing else known
  std::vector<EdgePoint> points;    // without outliers; offset_px: from the pose that was given
  std::size_t pieces_left_out = 0;  // found, but apart from their line or from all others
  // Scatter of the pieces about the best fit beyond their noise, px: common to a line, of a piece.
  double line_std_px = 0;
  double piece_std_px = 0;
};

// Part of the frame that find_silhouette() needs, px.
PixelRect silhouette_window(const RayScene& scene, const CameraIntrinsics& intrinsics,
                            const Rigid3d& camera_from_world, const SilhouetteOptions& options);

// All shots by one camera that stands still. (1) Coarse: on cells of which some 240 are in the
// width, the turn of the camera, as a shift of the image, with the best contrast
// (inside - outside) / (inside + outside) over all contours. (2) From these cells to the raw's own
// samples, each half the size of the one before: pieces located (edge_points()), pose by
// least squares with Cauchy's loss, so that clutter and unlit edges have little say; pieces alone
// on their line are dropped. (3) Pieces off by more than six robust deviations are left out,
// scatter of pieces about their line and of lines about the pose found by moments (R. C. Paule, J.
// Mandel, "Consensus values and weighting factors", 1982). Deterministic. Throws
// std::invalid_argument on no shots and options out of range.
Silhouette find_silhouette(const std::vector<EdgeShot>& shots, const CameraIntrinsics& intrinsics,
                           const Rigid3d& camera_from_world, const SilhouetteOptions& options = {});

}  // namespace scattermeter::calib
