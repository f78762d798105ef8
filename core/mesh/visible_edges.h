// Edges of a body that a picture of it shows.
#pragma once

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
  int line_idx = 0;           // pieces of one straight line of the mesh share it
  Eigen::Vector3d center_mm;  // world
  Eigen::Vector3d half_mm;    // the piece is center +- half
  // Unit, at right angles to the edge and to the line of sight: away from the body (contour, step),
  // from one facet to the other (crease).
  Eigen::Vector3d outward;
};

struct VisibleEdgesOptions {
  double step_rad = 0.004;  // longest piece, as seen, > 0
  // This far from the piece on both sides, as seen, there is only what the kind states:
  // no other edge, no background, no part before it. 0: pieces up to the very corners.
  double clearance_rad = 0.0;
  double crease_rad = 0.3;  // normals that differ by less belong to one smooth surface
};

// Edges between facets of which one faces the eye (contour, step), or both and which meet at more
// than crease_rad; cut into equal pieces; seen is what rays to the middle and to both ends of a
// piece say, a little to its sides. In the order of the mesh's edges. Precondition: the eye is
// outside the closed mesh.
std::vector<EdgePiece> visible_edges(const RayScene& scene, const Eigen::Vector3d& eye_mm,
                                     const VisibleEdgesOptions& options = {});

}  // namespace scattermeter
