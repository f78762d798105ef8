// Reading of Wavefront OBJ meshes, the door to tinyobjloader.
#pragma once

#include <cstddef>
#include <string>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter::capture {

// Reads all shapes of the file as one triangle mesh in double precision, coordinates in mm in the
// world frame. Polygons of any size, convex or not, are triangulated; equal vertices are merged;
// materials, normals and texture coordinates are ignored.
// Throws InputError naming the file (and the line where it is known) when it is missing, breaks the
// syntax (see obj_syntax.h), has no faces or more than `max_triangles`. Whether the mesh bounds a
// body is checked by core's mesh_problem(), not here.
TriangleMesh read_obj(const std::string& path, std::size_t max_triangles = 20'000'000);

}  // namespace scattermeter::capture
