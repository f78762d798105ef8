#include "apps/checking/check.h"

namespace scattermeter::apps {

std::vector<CheckItem> check_outline(const CheckedRig& checked) {
  if (!checked.outline) return {};
  const calib::SilhouetteCheck& outline = *checked.outline;
  std::vector<CheckDetail> shifts;
  for (std::size_t i = 0; i < outline.shots.size(); ++i) {
    const calib::SilhouetteShot& seen = outline.shots[i];
    if (!seen.found) continue;
    CheckDetail d = checked.of_shot(i, seen.shift_px.norm());
    d.std = seen.shift_std_px.norm();
    shifts.push_back(d);
  }
  CheckItem item = judged("outline", "px of shift", {checked.options.max_outline_px},
                          "pose, meshes or lens differ from the rig", shifts);
  if (outline.shots_found == 0) return {item};
  // The verdict is that of the silhouettes' own test, which accounts for the uncertainty of the
  // pose; the limit is for what it cannot see. Shifts below these limits do not affect a
  // measurement, however significant.
  constexpr double kTooSmall_px = 0.15;
  constexpr double kTooRough_px = 0.5;
  if (!outline.diagnosis.agrees && (item.rms > kTooSmall_px || outline.rms_px > kTooRough_px)) {
    item.passed = false;
    item.advice = outline.diagnosis.verdict;
  }
  if (!checked.shared_pose) return {item};  // the board moves along with the camera
  CheckDetail d;
  d.where = "largest between shots of one object";
  d.value = outline.drift_px;
  d.std = outline.drift_std_px;
  CheckItem drift = judged("camera between shots", "px", {checked.options.max_outline_px},
                           "the camera moved", {d});
  if (outline.drifts && outline.drift_px > kTooSmall_px) {
    drift.passed = false;
    drift.advice = outline.drift_verdict;
  }
  return {item, drift};
}

}  // namespace scattermeter::apps
