#include "apps/simulate.h"

#include <filesystem>
#include <optional>
#include <system_error>

#include "apps/object_scene.h"
#include "apps/progress.h"
#include "apps/simulate_camera_calibration.h"
#include "apps/simulate_led_calibration.h"
#include "apps/simulate_radiance_calibration.h"
#include "apps/virtual_shots.h"
#include "core/input_error.h"

namespace scattermeter::apps {

SimulatedShots simulate(const Rig& rig, const std::string& out_folder,
                        const SimulateOptions& options) {
  ObjectScenes scenes;
  std::optional<VirtualShots> shots;
  if (options.scene) {
    scenes = open_objects(rig);
    RenderTransport transport = options.transport;
    transport.seed = options.seed;
    shots.emplace(rig, scenes, VirtualShotOptions{options.noise, options.quiet, transport});
  }
  std::error_code error;
  std::filesystem::create_directories(out_folder, error);
  if (error) throw InputError(out_folder, "the folder cannot be made: " + error.message());
  SimulatedShots made;
  if (shots) {
    Progress progress("exposing", static_cast<int>(shots->size()), options.quiet);
    made.monte_carlo_std = shots->monte_carlo_std();
    for (std::size_t i = 0; i < shots->size(); ++i) {
      made.paths.push_back((std::filesystem::path(out_folder) / rig.shots[i].file).string());
      shots->write(i, options.seed, made.paths.back());
      progress.step();
    }
  }
  if (options.calibration) {
    for (const auto& part :
         {simulate_camera_calibration, simulate_led_calibration, simulate_radiance_calibration}) {
      const std::vector<std::string> paths = part(rig, out_folder, options);
      made.paths.insert(made.paths.end(), paths.begin(), paths.end());
    }
  }
  return made;
}

}  // namespace scattermeter::apps
