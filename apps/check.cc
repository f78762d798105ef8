#include "apps/check.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "apps/check_stations.h"

namespace scattermeter::apps {

bool CheckReport::passed() const {
  return std::all_of(items.begin(), items.end(), [](const CheckItem& i) { return i.passed; });
}

const std::vector<CheckStation>& check_stations() {
  static const std::vector<CheckStation> kStations = {
      check_settings, check_pose,  check_outline,    check_exposure,
      check_bracket,  check_noise, check_black,      check_radiance,
      check_identity, check_light, check_led_places, check_led_shots};
  return kStations;
}

CheckReport check_report(const CheckedRig& checked) {
  CheckReport report;
  report.notes = checked.notes;
  if (checked.shared_pose) {
    const Eigen::Vector3d& s = checked.shared_pose->center_std_mm;
    report.notes.push_back(fmt::format(
        "camera centre known to {:.3f}, {:.3f}, {:.3f} mm (std in x, y, z)", s.x(), s.y(), s.z()));
  }
  for (const CheckedTask& task : checked.fit.tasks) {
    if (task.departures) continue;
    report.notes.push_back(fmt::format(
        "{} {}: no joint model, so its light is not judged{}", task.material,
        kRgbName.at(task.channel),
        task.estimate.reasons.empty() ? "" : " (" + task.estimate.reasons.front() + ")"));
  }
  for (const CheckStation& station : check_stations()) {
    for (CheckItem& item : station(checked)) report.items.push_back(std::move(item));
  }
  return report;
}

}  // namespace scattermeter::apps
