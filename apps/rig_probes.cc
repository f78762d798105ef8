#include "apps/rig_probes.h"

#include <utility>

#include "capture/probe_reader.h"
#include "core/input_error.h"

namespace scattermeter::apps {
namespace {

// Radiance 1 from everywhere.
Environment even_environment() {
  Environment even;
  even.width_px = 4;
  even.height_px = 2;
  even.radiance.assign(std::size_t{3} * 4 * 2, 1.0F);
  return even;
}

}  // namespace

RigProbes open_probes(const Rig& rig) {
  RigProbes probes;
  for (const RigShot& shot : rig.shots) {
    for (const std::string& name : shot.lights) {
      const RigLight& light = rig.light(name);
      if (!light.environment || probes.contains(name)) continue;
      if (light.is_ambient) {
        probes.try_emplace(name, even_environment());
        continue;
      }
      try {
        Environment environment;
        if (light.environment->image) {
          environment = *light.environment->image;
        } else {
          capture::ProbeImage image =
              capture::read_probe(light.environment->image_path,
                                  {static_cast<std::size_t>(1e6 * rig.limits.probe_megapixels)});
          environment.width_px = image.width_px;
          environment.height_px = image.height_px;
          environment.radiance = std::move(image.radiance);
        }
        environment.projection = light.environment->projection;
        environment.world_from_probe = light.environment->world_from_probe;
        probes.try_emplace(name, std::move(environment));
      } catch (const InputError& e) {
        throw InputError(rig.at(light.line) + ": lights." + name + ".image", e.what());
      }
    }
  }
  return probes;
}

std::unique_ptr<EntrySource> entry_of(const std::string& name, const RigLight& light,
                                      const RigProbes& probes, const RayScene& scene, int channel,
                                      double eta_int_over_ext) {
  if (!light.environment) return led_entry(scene, light.led, eta_int_over_ext);
  return environment_entry(scene, probes.at(name).environment(), channel, eta_int_over_ext);
}

}  // namespace scattermeter::apps
