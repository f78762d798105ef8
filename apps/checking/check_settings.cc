#include <algorithm>
#include <cmath>
#include <map>

#include "apps/checking/check.h"

namespace scattermeter::apps {
namespace {

// Deviation of each shot's setting from the most frequent one, in percent.
CheckItem same_setting(const CheckedRig& checked, const std::string& what,
                       double ObservedShot::*setting, const std::string& advice) {
  std::map<double, int> uses;
  for (const ObservedShot& shot : checked.shots) ++uses[shot.*setting];
  double usual = 0.0;
  int most = 0;
  for (const auto& [value, n] : uses) {
    if (n > most) {
      usual = value;
      most = n;
    }
  }
  std::vector<CheckDetail> details;
  for (std::size_t i = 0; i < checked.shots.size(); ++i) {
    const double value = checked.shots[i].*setting;
    // 0 if the files do not state it.
    const double off = value == usual ? 0.0 : 100.0 * (value / usual - 1.0);
    details.push_back(checked.of_shot(i, off));
  }
  // Files round the settings, but real steps are larger than this.
  return judged(what, "% off the usual", {0.5}, advice, details);
}

}  // namespace

std::vector<CheckItem> check_settings(const CheckedRig& checked) {
  return {
      same_setting(checked, "aperture", &ObservedShot::f_number,
                   "use one aperture for all shots, as the responsivity depends on it"),
      same_setting(checked, "ISO setting", &ObservedShot::iso,
                   "use one ISO setting for all shots, as responsivity and noise depend on it")};
}

}  // namespace scattermeter::apps
