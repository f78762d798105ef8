#include "apps/planning/plan_assumptions.h"

#include <fmt/core.h>

namespace scattermeter::apps {

std::vector<std::string> plan_assumptions(const Plan& plan) {
  std::vector<std::string> out;
  out.push_back(plan.from_truth
                    ? "The materials are the rig's truth.materials."
                    : "The materials are the middle and the corners of the given range.");
  out.push_back(
      fmt::format("The noise is that of {}: {:.3g} electrons per count and {:.3g} counts of read "
                  "noise (green).",
                  plan.calibrated_noise ? "camera.radiance" : "camera.sensor",
                  plan.noise[1].gain_e_per_count, plan.noise[1].read_noise_counts));
  out.emplace_back(
      "The expected shots are rendered by the dipole, and the dipole is fitted to them, as by "
      "measure --model dipole. If measure has to use transport, the Monte Carlo error of its paths "
      "is added, and the information in the shape is not in the forecast.");
  out.emplace_back(
      "All positions are those of the rig; the standard deviations of LEDs, pose, lens, scale and "
      "eta are those stated by the rig and its calibrations.");
  if (!plan.brightness_known) {
    out.emplace_back(
        "The rig has no responsivity: the brightness of the shots is unknown, and the brightest "
        "point is assumed at three quarters of the range.");
  }
  if (plan.neutral_camera) {
    out.emplace_back(
        "The rig has no truth.sensor: the camera is assumed to need no correction, with the "
        "uncertainties stated by camera.radiance.");
  }
  if (!plan.suggested_shots.empty()) {
    out.emplace_back(
        "Maps and gains of other shots are linearised on coarse patches and relative to the "
        "planned shots. The added shot is exposed so that nothing clips; its LED has the "
        "brightness and the uncertainties of an existing one and hides nothing from the camera; "
        "the position of a card's edge is exact.");
  }
  return out;
}

}  // namespace scattermeter::apps
