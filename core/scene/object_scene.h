// The geometry of a scene's objects.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/ray_scene.h"
#include "core/mesh/triangle_mesh.h"
#include "core/scene/scene.h"
#include "core/view/camera_view.h"

namespace scattermeter {

struct ObjectScene {
  const SceneObject* stated = nullptr;
  std::unique_ptr<RayScene> rays;  // holds the mesh
  Box3d box;
  bool is_round = false;  // without edges (core/mesh/creases.h)
  // Of the turns about the box's centre (core/mesh/turning_symmetry.h).
  Eigen::Matrix3d displacing_turns = Eigen::Matrix3d::Identity();
  const TriangleMesh& mesh() const { return rays->mesh(); }
  double size_mm() const { return rays->size_mm(); }
  double diagonal_mm() const { return box.size_mm().norm(); }
};

// Objects by name.
using ObjectScenes = std::map<std::string, ObjectScene>;

// Checks the mesh, moves it to its position in the world (SceneObject::world_from_mesh) and builds
// the geometry of an object of the scene, which must outlive it. Throws InputError naming line,
// object, mesh file and fault: open, inside out, in metres.
ObjectScene object_scene(const Scene& scene, const SceneObject& object, const TriangleMesh& mesh);

// Throws InputError where a light of a shot is inside the object that it lights.
void require_lights_outside(const Scene& scene, const ObjectScenes& objects);

// Throws InputError when an object lies behind the camera, around it, or outside its frame.
void require_in_view(const Scene& scene, const ObjectScenes& objects, const CameraView& view,
                     const std::string& name);

}  // namespace scattermeter
