// The points of a body that lie beside the edges of its mesh.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter::apps {

// For each point of the surface, whether an edge of the mesh at which two facets meet at more than
// 0.3 rad is nearer than `near_mm`.
std::vector<bool> beside_edges(const TriangleMesh& mesh,
                               const std::vector<Eigen::Vector3d>& points_mm, double near_mm);

}  // namespace scattermeter::apps
