#include "apps/rig/rig.h"

#include <utility>

#include "capture/sensor/radiance_calibration.h"

namespace scattermeter::apps {

std::set<std::string> calibration_files(const Rig& rig) {
  std::set<std::string> files;
  const auto add = [&](const auto& shots) {
    for (const auto& shot : shots) files.insert(shot.file);
  };
  if (!rig.pose.board_shot.empty()) files.insert(rig.pose.board_shot);
  const RigCalibration& calibration = rig.calibration;
  if (calibration.camera) add(calibration.camera->shots);
  if (calibration.led) add(calibration.led->shots);
  if (calibration.radiance) {
    add(calibration.radiance->dark);
    add(calibration.radiance->flats);
    if (calibration.radiance->white) add(calibration.radiance->white->shots);
    if (calibration.radiance->glare) add(calibration.radiance->glare->shots);
  }
  return files;
}

SensorNoise noise_in_force(const Rig& rig) {
  return rig.decoding.radiance ? rig.decoding.radiance->correction.noise[1]
                               : rig.scene.camera.sensor.noise;
}

void use_radiance(Rig& rig, std::shared_ptr<const capture::RadianceCalibration> radiance,
                  const std::string& path) {
  rig.scene.camera.glare_std =
      radiance ? radiance->correction.glare_std : std::array<double, kRgb>{};
  if (radiance) {  // corrected by its flats
    rig.scene.camera.vignetting_std = 0.0;
    rig.scene.camera.non_linearity_std = 0.0;
  }
  rig.decoding.radiance = std::move(radiance);
  rig.decoding.radiance_path = path;
}

}  // namespace scattermeter::apps
