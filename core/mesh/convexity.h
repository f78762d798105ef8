// A test of a body's convexity.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// A closed, connected surface without self-intersections bounds a convex body if no edge is concave
// (Tietze 1928). An edge counts as concave where the neighbour rises above the facet's plane by
// more than 1e-9 of the body's size. Precondition: mesh_problem(mesh) is empty.
bool is_convex(const TriangleMesh& mesh);

}  // namespace scattermeter
