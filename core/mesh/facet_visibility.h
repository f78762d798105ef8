// Facets that are certainly unobstructed from the camera.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// By facet, whether all of it is certainly visible. In front of any hidden point of a facet that
// faces the camera lies a facet that faces away, where the line of sight leaves the body. So all
// facets that face away are registered in the cells of a picture; a facet that faces the camera and
// has none of them in front of it in any cell that it may touch is visible. Others may be visible
// as well; for a camera so near that a vertex lies 60 degrees or more off the axis, all are left to
// rays. Precondition: the camera is outside the body.
std::vector<bool> surely_seen(const TriangleMesh& mesh, const Eigen::Vector3d& camera_in_world_mm);

}  // namespace scattermeter
