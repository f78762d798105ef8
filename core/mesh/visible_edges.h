// The edges of a body that are visible in a picture of it.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/ray_scene.h"
#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

enum class EdgeKind {
  kContour,  // the body on one side, nothing behind the other
  kStep,     // the body on one side, a farther part of it behind the other
  kCrease,   // two facets that meet at an angle, both seen
};

// A straight piece of an edge.
struct EdgePiece {
  EdgeKind kind = EdgeKind::kContour;
  int line_idx = 0;  // common to the pieces of one straight line of the mesh
  std::array<Eigen::Vector3d, 2> line_end_mm;  // vertices of the mesh; of lines that meet, the same
  Eigen::Vector3d center_mm;                   // world
  Eigen::Vector3d half_mm;                     // the piece is center +- half
  // Unit, perpendicular to the edge and to the line of sight: away from the body (contour, step),
  // from one facet to the other (crease).
  Eigen::Vector3d outward;
};

struct VisibleEdgesOptions {
  double step_rad = 0.004;  // longest piece, as seen, > 0
  // Within this angle on both sides of the piece there is only what its kind implies: no other
  // edge, no background, no part in front of it. 0: pieces reach up to the corners.
  double clearance_rad = 0.0;
  double crease_rad = 0.3;  // normals that differ by less belong to one smooth surface
};

// Edges between facets of which one faces the eye (contour, step), or both do and meet at more than
// crease_rad, cut into equal pieces. Visibility is decided by rays slightly to the sides of a
// piece's middle and both ends. In the order of the mesh's edges. Precondition: the eye is outside
// the closed mesh.
std::vector<EdgePiece> visible_edges(const RayScene& scene, const Eigen::Vector3d& eye_mm,
                                     const VisibleEdgesOptions& options = {});

}  // namespace scattermeter
