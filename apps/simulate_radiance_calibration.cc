#include "apps/simulate_radiance_calibration.h"

#include <filesystem>

#include "apps/progress.h"
#include "apps/radiance_shots.h"

namespace scattermeter::apps {

std::vector<std::string> simulate_radiance_calibration(const Rig& rig,
                                                       const std::string& out_folder,
                                                       const SimulateOptions& options) {
  std::vector<std::string> paths;
  if (!rig.calibration.radiance) return paths;
  const RadianceShots shots(rig, options.noise);
  const std::vector<RadianceShot> all = all_radiance_shots(*rig.calibration.radiance);
  Progress progress("exposing for radiance", static_cast<int>(all.size()), options.quiet);
  for (const RadianceShot& shot : all) {
    paths.push_back((std::filesystem::path(out_folder) / shot.file).string());
    shots.write(shot, options.seed, paths.back());
    progress.step();
  }
  return paths;
}

}  // namespace scattermeter::apps
