#include "apps/instrument/led_watch.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "core/estimation/contradictions.h"
#include "core/estimation/model_choice.h"
#include "core/nuisances/led_displacement.h"

namespace scattermeter::apps {

LedWatch::LedWatch(const Scene& scene, const SeenShots& seen, bool looks)
    : scene_(scene), seen_(seen), looks_(looks) {}

bool LedWatch::finds(const std::vector<ChannelResult>& results) {
  // An LED that is far off lets the dipole miss its images by a little, true transport by more.
  constexpr double kMisses = 5e-3;
  constexpr double kBent = 6.0;  // standard deviations of the image
  if (!looks_) return false;
  double image_in_std = 0.0;
  for (const ChannelResult& r : results) {
    if (r.model != "dipole" || !r.estimate.converged) continue;
    if (misses_image(r.estimate) && r.estimate.misfit_relative > kMisses) continue;
    image_in_std = std::max(image_in_std, r.image_in_std);
  }
  if (!(image_in_std > 0.0)) return false;
  LedsElsewhere there =
      leds_elsewhere(scene_, seen_.shots(), most_probable_pulls_of(results).pulls);
  if (!(there.bent * image_in_std > kBent)) return false;
  found_ = std::move(there.displacements);
  return true;
}

void displace_leds(const LedDisplacements& by, Scene& scene) {
  for (SceneLight& light : scene.lights) {
    const auto it = by.find(light.name);
    if (it != by.end()) light.led()->displace(it->second);
  }
}

std::string displaced_leds_note(const Scene& scene) {
  std::string out;
  for (const SceneLight& light : scene.lights) {
    const LedLight* led = light.led();
    if (led == nullptr || !led->stated) continue;
    const Eigen::Vector3d motion_mm = led->led.position_mm - led->stated->position_mm;
    const double turn_deg = 180.0 / std::numbers::pi *
                            std::acos(std::clamp(led->led.axis.dot(led->stated->axis), -1.0, 1.0));
    out += fmt::format(
        "{}{} is taken to be where the shots show it, [{:.2f}, {:.2f}, {:.2f}] mm from the stated "
        "position, turned by {:.2g} degrees, its exponent {:+.2g}",
        out.empty() ? "" : "; ", light.name, motion_mm.x(), motion_mm.y(), motion_mm.z(), turn_deg,
        led->led.exponent - led->stated->exponent);
  }
  return out;
}

}  // namespace scattermeter::apps
