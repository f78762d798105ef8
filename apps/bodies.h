// Bodies to shoot, made in code.
#pragma once

#include "core/triangle_mesh.h"

namespace scattermeter::apps {

// Closed meshes on z = 0, centred on the z axis, sides along x and y.

// A cube of 20 mm.
TriangleMesh cube_mesh();
// A square pyramid (base 16 mm, height 13 mm) on a pedestal of 22 x 22 x 7 mm.
TriangleMesh pyramid_on_pedestal_mesh();
// A square pyramid, base 20 mm, height 20 mm.
TriangleMesh pyramid_mesh();
// A sphere of 20 mm diameter: an icosahedron cut finer, its vertices moved onto the sphere;
// 20 * 4^levels triangles.
TriangleMesh sphere_mesh(int levels);

}  // namespace scattermeter::apps
