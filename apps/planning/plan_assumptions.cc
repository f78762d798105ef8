#include "apps/planning/plan_assumptions.h"

#include <fmt/core.h>

namespace scattermeter::apps {

std::vector<std::string> plan_assumptions(const Plan& plan) {
  std::vector<std::string> out;
  out.push_back(plan.from_truth
                    ? "The materials are the rig's truth.materials."
                    : "The materials are the middle and the corners of the range that was given.");
  out.push_back(
      fmt::format("The noise is that of {}: {:.3g} electrons a count and {:.3g} counts read noise "
                  "(green).",
                  plan.calibrated_noise ? "camera.radiance" : "camera.sensor",
                  plan.noise[1].gain_e_per_count, plan.noise[1].read_noise_counts));
  out.emplace_back(
      "The dipole makes the expected shots and the dipole is fitted to them, as measure --model "
      "dipole does. Where measure has to answer by transport, the Monte Carlo error of its paths "
      "comes on top, and what the shape adds to the information is not in the forecast.");
  out.emplace_back(
      "Everything stands where the rig says; standard deviations of LEDs, pose, lens, scale and "
      "eta "
      "are those that the rig and its calibrations state.");
  if (!plan.brightness_known) {
    out.emplace_back(
        "The rig has no responsivity: how bright a shot will be is not known, and the brightest "
        "place counts as three quarters of the range.");
  }
  if (plan.neutral_camera) {
    out.emplace_back(
        "The rig has no truth.sensor: the camera counts as one that needs no correction, known as "
        "well as camera.radiance states.");
  }
  if (!plan.suggested_shots.empty()) {
    out.emplace_back(
        "Maps and gains of other shots are linearised on coarse patches and told relative to the "
        "shots as planned. The added shot is exposed so that nothing clips; its LED is as bright "
        "and as well known as the one it is like, and hides nothing from the camera; a card's edge "
        "counts as exactly placed.");
  }
  return out;
}

}  // namespace scattermeter::apps
