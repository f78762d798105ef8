#include "core/scene/seen_object.h"

#include <algorithm>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

namespace scattermeter {

std::shared_ptr<const SeenObject> see(const Scene& scene, const ObjectScenes& objects,
                                      const LitObjects& lit, const std::string& object,
                                      const PoseResult& pose, const PoseShift& shift,
                                      SampleMapStore* maps) {
  const CameraView view{scene.camera.intrinsics, shifted_pose(pose.camera_from_world, shift)};
  auto seen = std::make_shared<SeenObject>();
  seen->shift = shift;
  seen->object = &objects.at(object);
  seen->patches = &lit.patches(object);
  seen->camera_center_mm = view.center_in_world_mm();
  // Standard deviations of the edges: they hardly reach farther.
  constexpr double kReachOfEdges = 3.0;
  // Seen more slantingly, the surface under a sample moves by more than so many patches when the
  // object is displaced by its standard deviation. Of a position that was found by outline, most of
  // that is along the line of sight.
  constexpr double kPatches = 2.0;
  constexpr double kMostSlant = 0.15;
  SampleMapOptions options;
  if (!seen->object->is_round) {
    options.edge_reach_mm = kReachOfEdges * seen->object->stated->edge_std_mm;
  }
  options.least_cosine = std::min(kMostSlant, seen->object->stated->position_std_mm /
                                                  (kPatches * seen->patches->patch_size_mm()));
  seen->map = map_samples(view, *seen->object->rays, *seen->patches,
                          seen->object->stated->eta_int_over_ext, options, maps);
  for (std::size_t row = 0; row < seen->map.patch_of_row.size(); ++row) {
    seen->sites.push_back(exit_samples(*seen->patches, seen->map.patch_of_row[row],
                                       seen->map.samples[row], seen->map.of_quarters[row]));
  }
  return seen;
}

std::shared_ptr<const SeenObject> with_rows(const SeenObject& seen, const RowChoice& choice) {
  auto out = std::make_shared<SeenObject>();
  out->object = seen.object;
  out->patches = seen.patches;
  out->camera_center_mm = seen.camera_center_mm;
  out->shift = seen.shift;
  out->shadows = seen.shadows;
  out->map = with_rows(seen.map, choice);
  for (const std::size_t row : choice.rows) out->sites.push_back(seen.sites.at(row));
  return out;
}

SharedView see_all(const Scene& scene, const ObjectScenes& objects, const LitObjects& lit,
                   const PoseResult& pose, const std::map<std::string, PoseShift>& shifts,
                   const std::set<std::string>& only, SampleMapStore* maps) {
  SharedView view{pose, {}};
  struct Item {
    const std::string& name;
    PoseShift shift;
    std::shared_ptr<const SeenObject>& seen;
  };
  std::vector<Item> list;
  for (const auto& [name, object] : objects) {
    if (!only.empty() && !only.contains(name)) continue;
    const auto at = shifts.find(name);
    const PoseShift shift = at == shifts.end() ? PoseShift(PoseShift::Zero()) : at->second;
    require_in_view(scene, objects,
                    {scene.camera.intrinsics, shifted_pose(pose.camera_from_world, shift)}, name);
    list.push_back({name, shift, view.objects[name]});
  }
  tbb::parallel_for(std::size_t{0}, list.size(), [&](std::size_t i) {
    list[i].seen = see(scene, objects, lit, list[i].name, pose, list[i].shift, maps);
  });
  return view;
}

}  // namespace scattermeter
