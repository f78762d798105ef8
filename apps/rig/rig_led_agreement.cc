#include "apps/rig/rig_led_agreement.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

#include "core/base/input_error.h"

namespace scattermeter::apps {

void take_responsivity_of_leds(const YamlField& lights, Rig& rig) {
  const LedLight* first = nullptr;
  for (const SceneLight& light : rig.scene.lights) {
    const LedLight* led = light.led();
    if (led == nullptr || !led->calibrated_for) continue;
    const YamlField field = lights.at(light.name).at("calibration");
    if (first == nullptr && !rig.scene.camera.responsivity) {
      for (const SceneLight& other : rig.scene.lights) {
        const bool has_responsivity = other.led() != nullptr && other.led()->calibrated_for;
        if (!has_responsivity && !other->is_fitted()) {
          field.fail("its intensity is valid for the responsivity in the file, but light " +
                     other.name +
                     " has no such calibration: camera.responsivity_counts_mm2_sr_per_W_s must "
                     "state the responsivity for both");
        }
      }
      rig.scene.camera.responsivity = led->calibrated_for;
      rig.scene.camera.responsivity_relative_std = 0.0;
    }
    first = led;
    for (std::size_t c = 0; c < 3; ++c) {
      if (std::abs((*led->calibrated_for)[c] / (*rig.scene.camera.responsivity)[c] - 1.0) > 1e-9) {
        field.fail("its intensity is valid for a responsivity of " +
                   std::to_string((*led->calibrated_for)[c]) + ", but the camera's is " +
                   std::to_string((*rig.scene.camera.responsivity)[c]) + " (" + "RGB"[c] + ")");
      }
    }
  }
}

void require_different_leds(const YamlField& lights, const Scene& scene) {
  for (auto one = scene.lights.begin(); one != scene.lights.end(); ++one) {
    if (one->led() == nullptr || one->led()->calibrated_for) continue;
    const Led& led = one->led()->led;
    for (auto other = scene.lights.begin(); other != one; ++other) {
      if (other->led() == nullptr) continue;
      const Led& same = other->led()->led;
      if (led.position_mm != same.position_mm || led.axis != same.axis ||
          (led.intensity_W_per_sr != same.intensity_W_per_sr).any()) {
        continue;
      }
      lights.at(one->name).fail("has position, axis and intensity of " + other->name +
                                ": state where it is, or list one of the two only");
    }
  }
}

void require_radiance_of_leds(const Rig& rig) {
  const bool is_corrected = rig.decoding.radiance != nullptr;
  for (const SceneLight& light : rig.scene.lights) {
    if (light.led() == nullptr || !light.led()->radiance_corrected) continue;
    if (*light.led()->radiance_corrected == is_corrected) continue;
    throw InputError(
        rig.at(light.line) + ": lights." + light.name + ".calibration",
        is_corrected ? "was made without camera.radiance, which corrects the shots of this rig: "
                       "repeat `calibrate led`"
                     : "was made of shots that camera.radiance corrected, and this rig has none: "
                       "state it, or repeat `calibrate led`");
  }
}

}  // namespace scattermeter::apps
