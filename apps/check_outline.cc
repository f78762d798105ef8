#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/check_stations.h"

namespace scattermeter::apps {

std::vector<CheckItem> check_outline(const CheckedRig& checked) {
  std::vector<CheckDetail> shifts, drifts;
  std::string advice, drift_advice;
  bool agrees = true;
  bool still = true;
  bool found = false;
  std::size_t shot = 0;
  for (const SilhouetteCheck& outline : checked.outlines) {
    for (const SilhouetteShot& seen : outline.shots) {
      const std::size_t i = shot++;
      if (!seen.found) continue;
      CheckDetail d = checked.of_shot(i, seen.shift_px.norm());
      d.std = seen.shift_std_px.norm();
      shifts.push_back(d);
    }
    if (outline.shots_found == 0) continue;
    found = true;
    if (!outline.diagnosis.agrees) {
      agrees = false;
      if (!advice.empty()) advice += "; ";
      advice += outline.diagnosis.verdict;
    }
    if (outline.drifts) {
      still = false;
      drift_advice = outline.drift_verdict;
    }
    CheckDetail d;
    d.where = "largest between shots of one object";
    d.value = outline.drift_px;
    d.std = outline.drift_std_px;
    drifts.push_back(d);
  }
  // The verdict is that of the outline's own test, which knows the pose's uncertainty; the limit is
  // for what it cannot see.
  CheckItem item = judged("outline", "px of shift", {checked.options.max_outline_px},
                          found ? "pose, meshes or lens are not what the rig says"
                                : "no outline was found: is the background dark?",
                          shifts);
  // Significant as it may be, less than this is nothing that a measurement would notice.
  constexpr double kTooSmall_px = 0.15;
  if (!agrees && item.rms > kTooSmall_px) {
    item.passed = false;
    item.advice = advice;
  }
  CheckItem drift = judged("camera between shots", "px", {std::numeric_limits<double>::infinity()},
                           drift_advice, drifts);
  drift.passed = still;
  // A board's pose is each shot's own.
  if (!checked.shared_pose) return {item};
  return {item, drift};
}

}  // namespace scattermeter::apps
