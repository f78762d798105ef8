// Facets that nothing hides from the camera.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// By facet, whether all of it is surely seen. Before a hidden place of a facet that faces the
// camera lies a facet that faces away: light comes into the body there, leaves it, and comes in
// again. So all facets that face away are filed by where a picture shows them; a facet that faces
// the camera and has none of them before it in any cell that it may touch is seen. Others may be
// seen as well; from so near that a vertex lies 60 degrees or more off the axis, all are left to
// rays. Precondition: the camera is outside the body.
std::vector<bool> surely_seen(const TriangleMesh& mesh, const Eigen::Vector3d& camera_in_world_mm);

}  // namespace scattermeter
