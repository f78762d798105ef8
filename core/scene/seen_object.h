// The objects of a scene as seen from one camera pose.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/camera/camera_pose.h"
#include "core/camera/pose_shift.h"
#include "core/mesh/exit_site.h"
#include "core/mesh/patch_mesh.h"
#include "core/scene/lit_objects.h"
#include "core/scene/object_scene.h"
#include "core/view/chosen_rows.h"
#include "core/view/sample_map.h"
#include "core/view/sample_map_store.h"

namespace scattermeter {

struct SeenObject {
  const ObjectScene* object = nullptr;
  const PatchMesh* patches = nullptr;
  Eigen::Vector3d camera_center_mm = Eigen::Vector3d::Zero();
  // From the pose that the rig states to the one of this map: where the shots showed the object.
  PoseShift shift = PoseShift::Zero();
  SampleMap map;
  std::vector<ExitSite> sites;  // of the map's rows
  // The geometry that shadows an LED, if it is more than the object itself (changed_weights());
  // else null.
  const RayScene* shadows = nullptr;
  const RayScene& shadowing() const { return shadows != nullptr ? *shadows : *object->rays; }
  // At the centre of the row's patch, to the surface's normal.
  double cos_to_camera(std::size_t row) const {
    const Eigen::Vector3d& at_mm = sites[row].center_mm;
    return patches->normal_at(map.patch_of_row[row], at_mm)
        .dot((camera_center_mm - at_mm).normalized());
  }
};

// Seen from `pose`, shifted by `shift`. maps: of views of other programs; may be null.
// Precondition: require_in_view() accepts the object.
std::shared_ptr<const SeenObject> see(const Scene& scene, const ObjectScenes& objects,
                                      const LitObjects& lit, const std::string& object,
                                      const PoseResult& pose,
                                      const PoseShift& shift = PoseShift::Zero(),
                                      SampleMapStore* maps = nullptr);

// The same view with these rows only (core/view/chosen_rows.h).
std::shared_ptr<const SeenObject> with_rows(const SeenObject& seen, const RowChoice& choice);

// One pose common to all shots, and the objects as seen from it.
struct SharedView {
  PoseResult pose;
  std::map<std::string, std::shared_ptr<const SeenObject>> objects;
};

// shifts: of the pose relative to each object, by its name; none: zero. only: the objects of these
// names; empty: all. maps: see(). Throws InputError when one of them is out of view.
SharedView see_all(const Scene& scene, const ObjectScenes& objects, const LitObjects& lit,
                   const PoseResult& pose, const std::map<std::string, PoseShift>& shifts = {},
                   const std::set<std::string>& only = {}, SampleMapStore* maps = nullptr);

}  // namespace scattermeter
