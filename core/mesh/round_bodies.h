// Bodies without a flat side, made in code: many triangles.
#pragma once

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// Closed meshes, centred on the z axis, their lowest point at z = 0; the same digits every time.

// A sphere of radius 10 mm about (0, 0, 10): an icosahedron cut finer, 20 * 4^levels triangles with
// their corners on the sphere.
TriangleMesh sphere_mesh(int levels = 4);

// As a scan of a stone would be: 20480 triangles, none quite like another, some 0.35 mm wide; bumps
// and dents about a middle that sees all of the surface; concave in the dents. The longest side of
// its box is 20 mm.
TriangleMesh scanned_mesh();

}  // namespace scattermeter
