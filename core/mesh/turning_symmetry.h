// Turns that leave a body in its place.
#pragma once

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// The projector (3 x 3, symmetric) on the turns about center_mm, as rotation vectors, that displace
// the surface: the identity for a cube, zero for a sphere about its centre, and for a round
// cylinder about a point of its axis the plane across the axis. A turn displaces the surface if the
// motion along the normals (rms over the area) exceeds 4 % of the turn times the distance from the
// centre (rms): the facets of a fine mesh do not count, those of a prism of 12 sides do.
// Precondition: a mesh without mesh_problem().
Eigen::Matrix3d displacing_turns(const TriangleMesh& mesh, const Eigen::Vector3d& center_mm);

}  // namespace scattermeter
