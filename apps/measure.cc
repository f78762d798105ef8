#include "apps/measure.h"

#include <algorithm>

#include <oneapi/tbb/parallel_for.h>

#include "apps/file_digest.h"
#include "apps/instrument.h"
#include "apps/shot_folder.h"
#include "apps/shot_source.h"
#include "apps/stopwatch.h"

namespace scattermeter::apps {
namespace {

void list_inputs(const Rig& rig, const ObjectScenes& scenes,
                 const std::vector<std::vector<std::string>>& paths, Measurement& out) {
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
  for (const std::vector<std::string>& of_shot : paths) {
    files.insert(files.end(), of_shot.begin(), of_shot.end());
  }
  out.inputs.resize(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    out.inputs[i] = {files[i], sha256_of_file(files[i])};
  });
}

}  // namespace

bool Measurement::any_refused() const {
  return std::any_of(results.begin(), results.end(),
                     [](const ChannelResult& r) { return r.refused(); });
}

std::optional<DipoleDistance> dipole_distance(const ChannelResult& r) {
  if (!r.dipole || !r.dipole->converged || !r.estimate.converged) return std::nullopt;
  return DipoleDistance{
      r.dipole->sigma_s_prime_per_mm.value / r.estimate.sigma_s_prime_per_mm.value - 1.0,
      r.dipole->sigma_a_per_mm.value - r.estimate.sigma_a_per_mm.value};
}

const char* model_name(Model model) {
  switch (model) {
    case Model::kPaper:
      return "paper";
    case Model::kTransport:
      return "transport";
    default:
      return "dipole";
  }
}

Measurement measure(const Rig& rig, const std::string& shots_folder,
                    const MeasureOptions& options) {
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  const ShotFolder folder = match_shots(rig, shots_folder);
  const ObjectScenes scenes = open_objects(rig);
  Instrument instrument(rig, scenes, options);
  watch.lap("geometry");
  Measurement out = instrument.measure(shots_in_files(rig, folder.paths), watch);
  for (const std::string& name : folder.unlisted) {
    out.notes.push_back(name + ": not in the rig's list of shots, skipped");
  }
  list_inputs(rig, scenes, folder.paths, out);
  watch.lap("digests");
  watch.total();
  out.timing_s = timing_s;
  return out;
}

}  // namespace scattermeter::apps
