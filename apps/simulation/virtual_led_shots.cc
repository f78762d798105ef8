#include "apps/simulation/virtual_led_shots.h"

#include <algorithm>
#include <array>

#include "apps/simulation/chosen_exposure.h"
#include "apps/simulation/led_picture.h"
#include "apps/simulation/shot_renderer.h"
#include "calib/led/led_shots.h"
#include "core/base/input_error.h"

namespace scattermeter::apps {
namespace {

bool is_led_of(const Rig& rig, const std::string& name) {
  return std::any_of(rig.scene.lights.begin(), rig.scene.lights.end(),
                     [&](const SceneLight& l) { return l.name == name && l.led() != nullptr; });
}

}  // namespace

VirtualLedShots::VirtualLedShots(const Rig& rig, bool noise)
    : rig_(rig), sensor_(rig.scene, rig.truth.sensor, noise) {
  const CameraView view = true_view(rig);
  std::array<double, 3> responsivity{};
  responsivity.fill(calib::kNominalResponsivity);
  responsivity = rig.scene.camera.responsivity.value_or(responsivity);
  const SceneSensor& s = rig.scene.camera.sensor;
  const int width = view.intrinsics.width_px;
  for (const calib::LedCalibrationShot& shot : rig.calibration.led->shots) {
    if (shot.kind != calib::LedShotKind::kAmbient && !is_led_of(rig, shot.light)) {
      throw InputError(rig.at(shot.line) + ": calibration.led.shots." + shot.file + ".light",
                       "no such LED in lights, got " + shot.light);
    }
    std::vector<float> picture = led_picture(rig, shot, view);
    float brightest = 0.0F;
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const int x = static_cast<int>(i % static_cast<std::size_t>(width));
      const int y = static_cast<int>(i / static_cast<std::size_t>(width));
      picture[i] *= static_cast<float>(responsivity[static_cast<std::size_t>(s.cfa.at(x, y))]);
      brightest = std::max(brightest, picture[i]);
    }
    double exposure = 1.0;
    if (shot.exposure_s) {
      exposure = *shot.exposure_s;
    } else if (brightest > 0.0F) {
      exposure = full_exposure_s(rig.path, kExposedTo * sensor_.range_counts() / brightest);
    }
    exposure_s_.push_back(exposure);
    counts_.push_back(std::move(picture));
  }
  // An ambient shot is exposed like the shot of its plane.
  const std::vector<calib::LedCalibrationShot>& listed = rig.calibration.led->shots;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    if (listed[i].kind != calib::LedShotKind::kAmbient || listed[i].exposure_s) continue;
    const auto plane =
        std::find_if(listed.begin(), listed.end(), [&](const calib::LedCalibrationShot& shot) {
          return shot.kind == calib::LedShotKind::kPlane && shot.plane == listed[i].plane;
        });
    if (plane != listed.end()) {
      exposure_s_[i] = exposure_s_[static_cast<std::size_t>(plane - listed.begin())];
    }
  }
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    for (float& p : counts_[i]) p *= static_cast<float>(exposure_s_[i]);
  }
}

std::uint64_t VirtualLedShots::stream(std::size_t shot, std::uint64_t seed) const {
  return capture::VirtualSensor::stream(seed, rig_.calibration.led->shots.at(shot).file);
}

capture::RawFrame VirtualLedShots::frame(std::size_t shot, std::uint64_t seed) const {
  return sensor_.frame(counts_.at(shot), exposure_s(shot), stream(shot, seed));
}

void VirtualLedShots::write(std::size_t shot, std::uint64_t seed, const std::string& path) const {
  sensor_.write(path, counts_.at(shot), exposure_s(shot), stream(shot, seed));
}

}  // namespace scattermeter::apps
