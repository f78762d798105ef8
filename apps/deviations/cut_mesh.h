// Convex meshes cut by planes: chips and bevelled edges.
#pragma once

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter::apps {

// The part of a closed convex mesh where normal . x <= offset_mm, closed again along the cut; the
// mesh as it is if the plane does not cut it. `normal` has unit length. Throws
// std::invalid_argument if nothing is left.
TriangleMesh cut_mesh(const TriangleMesh& mesh, const Eigen::Vector3d& normal, double offset_mm);

// A closed convex mesh with each edge where it bends by more than 20 degrees bevelled: a plane with
// equal angles to the two faces takes `leg_mm` of each.
TriangleMesh bevelled_mesh(const TriangleMesh& mesh, double leg_mm);

// The corner farthest in the direction (unit length) cut off, perpendicular to it, by depth_mm.
TriangleMesh chipped_mesh(const TriangleMesh& mesh, const Eigen::Vector3d& direction,
                          double depth_mm);

}  // namespace scattermeter::apps
