// Points of a body's outline, predicted by its mesh and found in a shot.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_model.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/rigid3d.h"
#include "core/mesh/ray_scene.h"
#include "core/mesh/visible_edges.h"

namespace scattermeter::calib {

// A shot of one body.
struct EdgeShot {
  const RayScene* scene = nullptr;
  int body_idx = 0;
  CfaSamples samples;  // at least the body and what is searched around it
};

// A straight piece of an edge, and where it was found.
struct EdgePoint {
  int shot_idx = 0;
  int body_idx = 0;
  int line_idx = 0;  // of the body's mesh; see EdgePiece
  EdgeKind kind = EdgeKind::kContour;
  Eigen::Vector3d point_mm;     // of the mesh, world
  Eigen::Vector3d tangent;      // unit, world
  Eigen::Vector2d measured_px;  // the edge passes here, at right angles to outward
  Eigen::Vector2d outward;      // unit, in the image, away from the body
  double offset_px = 0;         // measured - predicted along outward, for the pose that was given
  double std_px = 0;            // of measured_px along outward
};

struct EdgePointOptions {
  int factor = 1;            // 1: the raw's own samples; even: cell_means() of that size
  double piece_px = 8;       // longest piece, and so strip, px of those cells
  double half_width_px = 5;  // of the strip, px of those cells
  double search_px = 2;      // px of those cells
  double max_std_px = 0.3;   // less certain pieces are left out, px of those cells
};

// Outline (contours, steps) of each shot's body as seen from the pose, each piece that is at least
// 3 cells long and clear on both sides located by locate_edge(): once with a blur of its own, and
// again with the median of those as the blur of all. Lengths of the answer are in px of the raw.
// Creases are left out: light that glows through a translucent body near an edge that it meets
// from both sides shows a kink there and no step, and a step fitted to it lies up to 0.15 mm off.
std::vector<EdgePoint> edge_points(const std::vector<EdgeShot>& shots,
                                   const CameraIntrinsics& intrinsics,
                                   const Rigid3d& camera_from_world,
                                   const EdgePointOptions& options = {});

}  // namespace scattermeter::calib
