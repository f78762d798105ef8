#include "calib/led/led_calibration_shots.h"

#include <algorithm>

namespace scattermeter::calib {

std::vector<std::string> LedCalibrationShots::lights() const {
  std::vector<std::string> names;
  for (const LedCalibrationShot& shot : shots) {
    if (shot.kind == LedShotKind::kAmbient) continue;
    if (std::find(names.begin(), names.end(), shot.light) == names.end()) {
      names.push_back(shot.light);
    }
  }
  return names;
}

std::optional<std::size_t> LedCalibrationShots::ambient_shot(std::size_t plane_idx) const {
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (shots[i].kind == LedShotKind::kAmbient && shots[i].plane == plane_idx) return i;
  }
  return std::nullopt;
}

}  // namespace scattermeter::calib
