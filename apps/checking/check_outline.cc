#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "apps/checking/check.h"
#include "apps/looks/closer_look.h"

namespace scattermeter::apps {
namespace {

// An object may stand elsewhere by as much as the rig states: the measurement begins where its
// outline shows it.
double largest_shift_px(const CheckedRig& checked) {
  constexpr double kStds = 3.0;
  double out = checked.options.max_outline_px;
  for (const ObservedShot& shot : checked.shots) {
    if (!shot.seen) continue;
    const ObjectScene& object = *shot.seen->object;
    out = std::max(out, kStds * object.stated->position_std_mm *
                            px_per_mm(checked.rig.scene.camera.intrinsics, object, shot.pose));
  }
  return out;
}

// Where no outline has enough straight edges, by the quick look at the whole contour, which needs
// none. An outline that is not seen at all fails: nothing says then that pose and mesh are right.
// That of a round body may end in the dark: a sphere's does where one LED leaves a side unlit.
CheckItem judged_by_look(const CheckedRig& checked, const CheckItem& unjudged) {
  if (!checked.shared_pose) {  // before a board
    CheckItem item = unjudged;
    if (checked.looks && !checked.looks->findings.empty()) {
      item.passed = false;
      item.advice = checked.looks->findings.front().sentence();
    }
    return item;
  }
  std::vector<CheckDetail> details;
  std::string advice = "the outline contradicts pose and mesh";
  if (checked.looks && checked.looks->diagnosis) {
    const calib::OutlineDiagnosis& d = *checked.looks->diagnosis;
    for (const std::size_t idx : checked.looks->looked_at) {
      CheckDetail shift = checked.of_shot(idx, d.shift_px.norm());
      shift.std = d.shift_std_px;
      details.push_back(shift);
    }
    const double beyond = checked.options.max_outline_px + 4.0 * d.shift_std_px;
    CheckItem item = judged("outline", "px of shift", {beyond}, advice, details);
    item.passed = d.agrees;
    if (!d.agrees) item.advice = d.explanations.at(1).text;
    return item;
  }
  const auto is_round = [](const ObservedShot& shot) {
    return shot.seen && shot.seen->object->is_round;
  };
  if (!checked.shots.empty() && std::all_of(checked.shots.begin(), checked.shots.end(), is_round)) {
    return unjudged;
  }
  for (std::size_t i = 0; i < checked.shots.size(); ++i) {
    details.push_back(checked.of_shot(i, std::numeric_limits<double>::quiet_NaN()));
  }
  return judged("outline", "px of shift", {checked.options.max_outline_px},
                "the object's outline is not found near where pose and mesh put it: look at pose, "
                "mesh and shots, or use a darker background",
                details);
}

}  // namespace

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
  CheckItem item = judged("outline", "px of shift", {largest_shift_px(checked)},
                          "pose, meshes or lens differ from the rig", shifts);
  if (outline.shots_found == 0) return {judged_by_look(checked, item)};
  // The verdict is that of the silhouettes' own test, which accounts for the uncertainty of the
  // pose; the limit is for what it cannot see. Shifts below these limits do not affect a
  // measurement, however significant.
  constexpr double kTooSmall_px = 0.15;
  constexpr double kTooRough_px = 0.5;
  const bool is_as_stated = checked.looks && checked.looks->findings.empty() &&
                            !checked.looks->shifts.empty() && item.passed;
  if (!outline.diagnosis.agrees && !is_as_stated &&
      (item.rms > kTooSmall_px || outline.rms_px > kTooRough_px)) {
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
