#include <cmath>

#include "apps/checking/check.h"

namespace scattermeter::apps {

std::vector<CheckItem> check_bracket(const CheckedRig& checked) {
  std::vector<CheckDetail> off;
  const double read_noise = checked.rig.scene.camera.sensor.noise.read_noise_counts;
  for (std::size_t i = 0; i < checked.shots.size(); ++i) {
    if (checked.shots[i].exposures.size() < 2) continue;
    for (const ShotExposure& e : checked.shots[i].exposures) {
      // An exposure that shares no sample with another cannot be compared.
      if (!std::isfinite(e.departure.log_ratio)) continue;
      CheckDetail d = checked.of_shot(i, 100.0 * std::expm1(e.departure.log_ratio));
      d.where = e.file;
      const double black_counts =
          std::hypot(e.black_std_counts, checked.options.max_black_drift_read_noises * read_noise);
      d.std = 100.0 * std::hypot(e.departure.noise_std, black_counts / e.departure.mean_counts);
      off.push_back(d);
    }
  }
  if (off.empty()) return {};
  return {judged("bracket", "% off the other exposures",
                 {checked.options.max_bracket_percent, false, false, checked.options.least_stds},
                 "run calibrate radiance, as the exposure times differ from those in the files, or "
                 "check whether the light changed",
                 off)};
}

}  // namespace scattermeter::apps
