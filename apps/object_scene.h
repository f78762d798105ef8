// The rig's objects, opened and checked.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "apps/camera_view.h"
#include "apps/rig.h"
#include "core/ray_scene.h"
#include "core/triangle_mesh.h"

namespace scattermeter::apps {

struct ObjectScene {
  const RigObject* rig = nullptr;
  std::unique_ptr<RayScene> rays;  // holds the mesh
  Box3d box;
  const TriangleMesh& mesh() const { return rays->mesh(); }
  double size_mm() const { return box.size_mm().maxCoeff(); }
  double diagonal_mm() const { return box.size_mm().norm(); }
};

// Objects by name.
using ObjectScenes = std::map<std::string, ObjectScene>;

// Opens the meshes of all objects that a shot refers to. Throws InputError naming rig line, object,
// mesh file and what is wrong: unreadable, open, empty, inside out, in metres; or an LED inside an
// object that it lights.
ObjectScenes open_objects(const Rig& rig);

// The same with meshes from elsewhere than the rig's files; the callback may throw InputError.
ObjectScenes open_objects(const Rig& rig,
                          const std::function<TriangleMesh(const RigObject&)>& mesh_of);

// Throws InputError when an object lies behind the camera, around it, or outside its frame.
void require_in_view(const Rig& rig, const ObjectScenes& objects, const CameraView& view,
                     const std::string& object);

}  // namespace scattermeter::apps
