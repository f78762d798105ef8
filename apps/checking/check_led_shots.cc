#include <cmath>
#include <string>

#include "apps/checking/check.h"
#include "calib/led/led_check.h"

namespace scattermeter::apps {

std::vector<CheckItem> check_led_shots(const CheckedRig& checked) {
  std::vector<CheckDetail> highlights, positions, planes, ambients, powers;
  std::string displacements;
  for (const calib::LedCheck& led : checked.leds) {
    const std::string& light = led.light;
    const auto add = [&](double value, double std, const std::string& what,
                         std::vector<CheckDetail>& list) {
      if (std::isnan(value)) return;
      CheckDetail d;
      d.where = light + what;
      d.value = value;
      d.std = std;
      list.push_back(d);
    };
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    add(led.highlight_worst_px, unknown, "", highlights);
    if (led.problem.empty()) {
      // The deviation of the length follows from the significance of all three coordinates.
      add(led.displacement_length_mm,
          led.displacement_stds > 0.0 ? led.displacement_length_mm / led.displacement_stds
                                      : unknown,
          "", positions);
      if (led.displacement_stds > checked.options.least_stds) {
        displacements += (displacements.empty() ? "" : "; ") + led.text;
      }
    }
    add(led.plane_rms_percent, unknown, "", planes);
    add(led.ambient_percent, led.ambient_std_percent,
        led.ambient_file.empty() ? "" : " " + led.ambient_file, ambients);
    for (Eigen::Index c = 0; c < 3; ++c) {
      add(led.power_change_percent[c], unknown,
          std::string(" ") + kRgbName.at(static_cast<std::size_t>(c)), powers);
    }
  }
  const CheckOptions& o = checked.options;
  std::vector<CheckItem> out;
  if (!highlights.empty()) {
    out.push_back(judged("LED highlights", "px", {o.max_pose_rms_px},
                         "calibrate the LEDs again: the position of one differs from the rig",
                         highlights));
  }
  if (!positions.empty()) {
    out.push_back(judged(
        "LED places, from their shots", "mm", {o.max_led_place_mm, false, false, o.least_stds},
        displacements.empty() ? "calibrate the LEDs again" : displacements, positions));
  }
  if (!planes.empty()) {
    out.push_back(judged("white plane under the LEDs", "%", {o.max_plane_percent},
                         "calibrate the LEDs again: position, axis or lobe has changed", planes));
    out.push_back(
        judged("light beside the LEDs on the white plane", "% of theirs",
               {o.max_plane_ambient_percent, false, false, o.least_stds},
               "shoot the planes with the LEDs off as well (calibration.led.shots of kind "
               "ambient), or darken the room",
               ambients));
    // Without a responsivity only its product with the power counts, which was calibrated.
    out.push_back(judged(
        "LED power, from the white plane", "%", {o.max_led_power_percent},
        "calibrate the LEDs again: their power or the camera's responsivity has changed", powers));
  }
  return out;
}

}  // namespace scattermeter::apps
