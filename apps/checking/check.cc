#include "apps/checking/check.h"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "apps/rig/rig_placeholders.h"
#include "core/base/progress.h"

namespace scattermeter::apps {

bool CheckReport::passed() const {
  return std::all_of(items.begin(), items.end(), [](const CheckItem& i) { return i.passed; });
}

const std::vector<Check>& checks() {
  static const std::vector<Check> kChecks = {
      check_first_look, check_settings,   check_pose,     check_outline,  check_exposure,
      check_bracket,    check_noise,      check_black,    check_radiance, check_identity,
      check_light,      check_led_places, check_led_shots};
  return kChecks;
}

CheckReport check_report(const CheckedRig& checked) {
  CheckReport report;
  report.notes = checked.notes;
  if (checked.shared_pose) {
    const Eigen::Vector3d& s = checked.shared_pose->center_std_mm;
    report.notes.push_back(fmt::format(
        "camera centre known to {:.3f}, {:.3f}, {:.3f} mm (std in x, y, z)", s.x(), s.y(), s.z()));
  }
  if (std::string quiet = quiet_note(checked); !quiet.empty()) {
    report.notes.push_back(std::move(quiet));
  }
  std::set<std::string> judged_materials;
  for (const CheckedChannel& fitted : checked.fit.channels) {
    if (fitted.departures) judged_materials.insert(fitted.material);
  }
  for (const CheckedChannel& fitted : checked.fit.channels) {
    // Of the channels that need transport, one for each material is judged.
    if (fitted.departures || judged_materials.contains(fitted.material)) continue;
    report.notes.push_back(fmt::format(
        "{} {}: no joint model, so its light is not judged{}", fitted.material,
        kRgbName.at(fitted.channel),
        fitted.estimate.reasons.empty() ? "" : " (" + fitted.estimate.reasons.front() + ")"));
  }
  for (const Check check : checks()) {
    for (CheckItem& item : check(checked)) report.items.push_back(std::move(item));
  }
  std::stable_partition(report.items.begin(), report.items.end(),
                        [](const CheckItem& i) { return !i.passed; });
  if (!report.passed()) tell_placeholders(checked.rig.path, report.notes);
  report.cause = probable_cause(checked, report.items);
  return report;
}

CheckReport check(const Rig& rig, const std::string& shots_folder, const CheckOptions& options,
                  Progress* progress) {
  CheckOptions own = options;
  own.progress = progress;
  return check_report(open_checked_rig(rig, shots_folder, own));
}

}  // namespace scattermeter::apps
