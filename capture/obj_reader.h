// Wavefront OBJ meshes through tinyobjloader.
#pragma once

#include <cstddef>
#include <string>

#include "core/triangle_mesh.h"

namespace scattermeter::capture {

// Reads every shape of the file as one triangle mesh; polygons of any size are triangulated
// (concave ones too), materials, normals and texture coordinates ignored, coordinates taken as mm
// in the world frame, equal vertices merged. Double precision.
// Throws InputError, naming the file (and line where it is known), when it is missing, holds no
// faces, an index out of range, a coordinate that is not a number, or more than `max_triangles`.
// What the mesh must be as a body is core's mesh_problem(); it is not checked here.
TriangleMesh read_obj(const std::string& path, std::size_t max_triangles = 20'000'000);

}  // namespace scattermeter::capture
