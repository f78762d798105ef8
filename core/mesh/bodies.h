// Test bodies generated in code.
#pragma once

#include <string>
#include <vector>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// Closed meshes on z = 0, centred on the z axis, sides along x and y.

// A cube of 20 mm.
TriangleMesh cube_mesh();
// A square pyramid (base 16 mm, height 13 mm) on a pedestal of 22 x 22 x 7 mm.
TriangleMesh pyramid_on_pedestal_mesh();
// A square pyramid, base 20 mm, height 20 mm.
TriangleMesh pyramid_mesh();
// A plate of 40 x 40 x 10 mm.
TriangleMesh slab_mesh();

// "cube", "pyramid" (on its pedestal), "sphere", "slab", "scan" (core/mesh/round_bodies.h).
const std::vector<std::string>& body_names();
// The body with one of these names; std::invalid_argument for any other.
TriangleMesh body_mesh(const std::string& name);

}  // namespace scattermeter
