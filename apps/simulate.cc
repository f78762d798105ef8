#include "apps/simulate.h"

#include <filesystem>
#include <system_error>

#include "apps/object_scene.h"
#include "apps/progress.h"
#include "apps/virtual_shots.h"
#include "core/input_error.h"

namespace scattermeter::apps {

SimulatedShots simulate(const Rig& rig, const std::string& out_folder,
                        const SimulateOptions& options) {
  const ObjectScenes scenes = open_objects(rig);
  RenderTransport transport = options.transport;
  transport.seed = options.seed;
  const VirtualShots shots(rig, scenes, {options.noise, options.quiet, transport});
  std::error_code error;
  std::filesystem::create_directories(out_folder, error);
  if (error) throw InputError(out_folder, "the folder cannot be made: " + error.message());
  Progress progress("exposing", static_cast<int>(shots.size()), options.quiet);
  SimulatedShots made;
  made.monte_carlo_std = shots.monte_carlo_std();
  for (std::size_t i = 0; i < shots.size(); ++i) {
    made.paths.push_back((std::filesystem::path(out_folder) / rig.shots[i].file).string());
    shots.write(i, options.seed, made.paths.back());
    progress.step();
  }
  return made;
}

}  // namespace scattermeter::apps
