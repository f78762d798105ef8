// Whether a body is convex.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// A closed surface of one piece that does not cut itself bounds a convex body where no edge is
// concave (Tietze 1928). An edge counts as concave where the neighbour rises above the facet's
// plane by more than 1e-9 of the body's size. Precondition: mesh_problem(mesh) is empty.
bool is_convex(const TriangleMesh& mesh);

}  // namespace scattermeter
