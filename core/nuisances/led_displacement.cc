#include "core/nuisances/led_displacement.h"

#include <algorithm>

#include "core/nuisances/view_shift.h"

namespace scattermeter {
namespace {

// Of a light at this distance: 1 / r^2 has 3 (d / r)^2 in the second order, cos^n some n a^2 / 2 by
// a turn a, and some (log cos)^2 / 2 by a change of n.
double left_out(const LedLight& led, const LedLight& there, double distance_mm) {
  constexpr double kOfExponent = 0.1;
  const double motion = (there.led.position_mm - led.led.position_mm).norm() / distance_mm;
  const double turn = (there.led.axis - led.led.axis).norm();
  const double spread = there.led.exponent - led.led.exponent;
  return 3.0 * motion * motion + 0.5 * std::max(1.0, led.led.exponent) * turn * turn +
         kOfExponent * spread * spread;
}

}  // namespace

LedsElsewhere leds_elsewhere(const Scene& scene, std::span<const ObservedShot> shots,
                             const std::vector<PriorPull>& pulls) {
  LedsElsewhere out;
  for (const ObservedShot& shot : shots) {
    for (const std::string& name : shot.stated->lights) {
      const LedLight* led = scene.light(name).led();
      if (led == nullptr || led->calibrated || !(led->moves() || led->turns() || led->spreads())) {
        continue;
      }
      Eigen::VectorXd by;
      for (const LightNuisance& v : led->nuisances(name, 0)) {
        if (v.of_change.size() == 0) continue;
        if (by.size() == 0) by.setZero(v.of_change.size());
        const auto pull = std::find_if(pulls.begin(), pulls.end(),
                                       [&](const PriorPull& p) { return p.name == v.name; });
        if (pull != pulls.end()) by += believable(*pull) * v.of_change;
      }
      LedLight there = *led;
      there.displace(by);
      const double distance_mm = (led->led.position_mm - shot.seen->object->box.center_mm()).norm();
      out.bent = std::max(out.bent, left_out(*led, there, distance_mm));
      out.displacements[name] = by;
    }
  }
  return out;
}

}  // namespace scattermeter
