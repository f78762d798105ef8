#include "apps/rig_inputs.h"

#include <algorithm>

#include <oneapi/tbb/parallel_for.h>

namespace scattermeter::apps {

std::vector<InputFile> rig_inputs(const Rig& rig, const ObjectScenes& scenes, FileDigests& digests,
                                  const std::vector<std::string>& more) {
  std::vector<std::string> files = {rig.path};
  for (const std::string& calibration : {rig.camera.intrinsics_path, rig.camera.radiance_path}) {
    if (!calibration.empty()) files.push_back(calibration);
  }
  for (const auto& [name, scene] : scenes) {
    if (std::find(files.begin(), files.end(), scene.rig->mesh_path) == files.end()) {
      files.push_back(scene.rig->mesh_path);
    }
  }
  for (const RigShot& shot : rig.shots) {
    for (const std::string& name : shot.lights) {
      const RigLight& light = rig.light(name);
      if (light.environment && !light.is_ambient && !light.environment->image &&
          std::find(files.begin(), files.end(), light.environment->image_path) == files.end()) {
        files.push_back(light.environment->image_path);
      }
      if (!light.calibration_path.empty() &&
          std::find(files.begin(), files.end(), light.calibration_path) == files.end()) {
        files.push_back(light.calibration_path);
      }
    }
  }
  files.insert(files.end(), more.begin(), more.end());
  std::vector<InputFile> out(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    out[i] = {files[i], digests.of(files[i])};
  });
  return out;
}

}  // namespace scattermeter::apps
