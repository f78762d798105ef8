// Curved test bodies of many triangles, generated in code.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// Closed meshes, centred on the z axis, their lowest point at z = 0; the same digits every time.

// A sphere of radius 10 mm about (0, 0, 10): a subdivided icosahedron, 20 * 4^levels triangles with
// their corners on the sphere.
TriangleMesh sphere_mesh(int levels = 4);

// A cylinder of radius 10 mm and height 20 mm with so many sides, in bands of facets some four
// times as long as they are wide; the circles of a cap have fewer corners towards its centre.
TriangleMesh cylinder_mesh(int sides = 288);

// Like the scan of a stone: 20480 triangles, all different, some 0.35 mm wide; star-shaped, with
// bumps and dents; concave in the dents. The longest side of its box is 20 mm.
TriangleMesh scanned_mesh();

}  // namespace scattermeter
