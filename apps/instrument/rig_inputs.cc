#include "apps/instrument/rig_inputs.h"

#include <algorithm>

#include <oneapi/tbb/parallel_for.h>

namespace scattermeter::apps {

std::vector<InputFile> rig_inputs(const Rig& rig, const ObjectScenes& objects,
                                  capture::FileDigests& digests,
                                  const std::vector<std::string>& more) {
  std::vector<std::string> files = {rig.path};
  for (const std::string& calibration : {rig.intrinsics_path, rig.decoding.radiance_path}) {
    if (!calibration.empty()) files.push_back(calibration);
  }
  const auto add = [&](const std::string& file) {
    if (std::find(files.begin(), files.end(), file) == files.end()) files.push_back(file);
  };
  for (const auto& [name, object] : objects) add(object.stated->mesh_path);
  for (const SceneShot& shot : rig.scene.shots) {
    for (const std::string& name : shot.lights) {
      for (const std::string& file : rig.scene.light(name).files) add(file);
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
