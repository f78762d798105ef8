#include "apps/simulation/simulate_radiance_calibration.h"

#include <filesystem>

#include "apps/simulation/radiance_shots.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

std::vector<std::string> simulate_radiance_calibration(const Rig& rig,
                                                       const std::string& out_folder,
                                                       const SimulateOptions& options,
                                                       Progress* progress) {
  std::vector<std::string> paths;
  if (!rig.calibration.radiance) return paths;
  const RadianceShots shots(rig, options.noise);
  const std::vector<calib::RadianceShot> all = all_radiance_shots(*rig.calibration.radiance);
  ProgressStage stage(progress, "exposing for radiance", all.size());
  for (const calib::RadianceShot& shot : all) {
    paths.push_back((std::filesystem::path(out_folder) / shot.file).string());
    shots.write(shot, options.seed, paths.back());
    stage.step();
  }
  return paths;
}

}  // namespace scattermeter::apps
