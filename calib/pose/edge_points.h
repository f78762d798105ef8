// Points of a body's outline, predicted from its mesh and located in a shot.
#pragma once

#include <array>
#include <optional>
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
  CfaSamples samples;  // at least the body and the search range around it
};

// A straight piece of an edge and its measured position.
struct EdgePoint {
  int shot_idx = 0;
  int body_idx = 0;
  int line_idx = 0;  // of the body's mesh; see EdgePiece
  std::array<Eigen::Vector3d, 2> line_end_mm;
  EdgeKind kind = EdgeKind::kContour;
  Eigen::Vector3d point_mm;     // on the mesh, world
  Eigen::Vector3d tangent;      // unit, world
  Eigen::Vector2d measured_px;  // a point on the edge, which is normal to outward
  Eigen::Vector2d outward;      // unit, in the image, away from the body
  double offset_px = 0;         // measured - predicted along outward, for the given pose
  double std_px = 0;            // of measured_px along outward
};

struct EdgePointOptions {
  int factor = 1;            // 1: the raw samples themselves; even: cell_means() of that size
  double piece_px = 8;       // longest piece and strip, px of those cells
  double half_width_px = 5;  // of the strip, px of those cells
  double search_px = 2;      // px of those cells
  double max_std_px = 0.3;   // pieces with a larger std are left out, px of those cells
};

// Points on the outline (contours, steps) of the body of each shot as seen from the pose. Each
// piece that is at least 3 cells long and unobstructed on both sides is located by locate_edge(),
// with the median of the blurs that fit a sample of the pieces. Lengths in the
// result are in px of the raw file. Creases are left out: light scattered in a translucent body
// near an edge that is lit from both sides has a kink there but no step, and a step fitted to it is
// up to 0.15 mm off.
std::vector<EdgePoint> edge_points(const std::vector<EdgeShot>& shots,
                                   const CameraIntrinsics& intrinsics,
                                   const Rigid3d& camera_from_world,
                                   const EdgePointOptions& options = {});

// Blur of the outline of one shot: covariance of the point spread, px^2 right and down, without the
// pixel's box. It has the least sum of absolute residuals to the squared blurs across at most 24
// pieces, by locate_edge() on the raw samples; pieces of one direction tell it in that direction
// and are taken for all. Pieces are searched up to 8 px away. Fewer than 8 pieces tell nothing:
// nullopt. Domain: up to 6 px.
std::optional<Eigen::Matrix2d> edge_blur_px2(const EdgeShot& shot,
                                             const CameraIntrinsics& intrinsics,
                                             const Rigid3d& camera_from_world);

}  // namespace scattermeter::calib
