// Pieces by name and size, for a rig that begins.
#pragma once

#include <string>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter::apps {

struct DraftedBody {
  std::string name;
  TriangleMesh mesh;
};

// The closed body that `text` stands for, on z = 0, centred on the z axis, sizes in mm along x, y
// and z: "cube:20", "box:30x20x10", "slab:40x40x10", "pyramid:20x20x15", "cylinder:20x20x30" (a
// prism of 288 sides), "sphere:20" (20,480 triangles). One size stands for all three. "a/bust.obj":
// the mesh of that file as it stands, by the file's name. Throws InputError naming --body or the
// file.
DraftedBody drafted_body(const std::string& text);

// Wavefront OBJ of a mesh, in mm.
std::string obj_text(const TriangleMesh& mesh);

}  // namespace scattermeter::apps
