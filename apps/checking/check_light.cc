#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "apps/checking/check.h"
#include "core/fit/common_slope.h"
#include "core/fit/prior_pulls.h"

namespace scattermeter::apps {
namespace {

// Relative power of a shot: mean over its channels, weighted by their variances.
struct ShotPower {
  double weight = 0, sum = 0;
};

// Drift of each LED over the shots, assumed to be taken in the rig's order. Levels are compared
// within a material only, as the dipole's error depends on the material.
std::vector<CheckDetail> drifts(const CheckedRig& checked, const std::vector<ShotPower>& powers) {
  std::vector<std::string> lights;
  for (const ObservedShot& shot : checked.shots) {
    if (shot.stated->lights.size() != 1) continue;
    const std::string& name = shot.stated->lights.front();
    if (std::find(lights.begin(), lights.end(), name) == lights.end()) lights.push_back(name);
  }
  const std::vector<std::string> materials = checked.rig.scene.materials();
  std::vector<CheckDetail> out;
  for (const std::string& light : lights) {
    std::vector<double> order, power;
    std::vector<int> group;
    for (std::size_t i = 0; i < checked.shots.size(); ++i) {
      const SceneShot& shot = *checked.shots[i].stated;
      if (shot.lights != std::vector<std::string>{light} || !(powers[i].weight > 0.0)) continue;
      order.push_back(static_cast<double>(i));
      power.push_back(powers[i].sum / powers[i].weight);
      group.push_back(static_cast<int>(
          std::find(materials.begin(), materials.end(), shot.material) - materials.begin()));
    }
    const Departure slope = common_slope(order, power, group);
    if (!std::isfinite(slope.std)) continue;
    const double span = order.back() - order.front();
    CheckDetail d;
    d.where = light;
    d.value = 100.0 * slope.value * span;
    d.std = 100.0 * slope.std * span;
    out.push_back(d);
  }
  return out;
}

// Of each channel, how far the fit would have the light's overall strength from what is stated.
std::vector<CheckDetail> strength(const CheckedRig& checked) {
  std::vector<CheckDetail> out;
  for (const CheckedChannel& fitted : checked.fit.channels) {
    if (!fitted.departures) continue;
    CheckDetail worst;
    for (const PriorPull& p : fitted.estimate.pulls) {
      if (p.group != "scale" && p.group != "LED power" && p.group != "exposure time") continue;
      if (!(std::abs(p.pull) > std::abs(worst.value))) continue;
      worst.value = p.pull;
      worst.where = fmt::format("{} {}: {}", fitted.material, kRgbName.at(fitted.channel), p.name);
    }
    if (!worst.where.empty()) out.push_back(worst);
  }
  return out;
}

// Where the residual lies along the edges of the mesh, these are the cause.
std::string residual_advice(const CheckedRig& checked) {
  constexpr double kOfEdges = 2.5;
  double excess = 0.0;
  for (const CheckedChannel& fitted : checked.fit.channels) {
    excess = std::max(excess, fitted.edge_excess);
  }
  if (excess > kOfEdges) {
    return fmt::format(
        "beside the edges of the mesh it is {:.1f} times that elsewhere: the object's edges are "
        "not "
        "as sharp; give the mesh their chamfer or radius",
        excess);
  }
  return "look at the shot: object moved, wrong mesh, wrong lights, or other light";
}

}  // namespace

std::vector<CheckItem> check_light(const CheckedRig& checked) {
  const CheckOptions& o = checked.options;
  std::vector<CheckDetail> power, even, residual;
  std::vector<ShotPower> powers(checked.shots.size());
  for (const CheckedChannel& fitted : checked.fit.channels) {
    if (!fitted.departures) continue;
    for (std::size_t k = 0; k < fitted.shots.size(); ++k) {
      const std::size_t i = fitted.shots[k];
      const auto add = [&](const Departure& d, std::vector<CheckDetail>& list) {
        CheckDetail detail = checked.of_channel(i, fitted.channel, 100.0 * d.value);
        detail.std = 100.0 * d.std;
        list.push_back(detail);
      };
      const Departure& p = fitted.departures->power_relative[k];
      if (fitted.shots.size() > 1) {
        add(p, power);
        powers[i].weight += 1.0 / (p.std * p.std);
        powers[i].sum += p.value / (p.std * p.std);
      }
      add(fitted.departures->even_relative[k], even);
      residual.push_back(
          checked.of_channel(i, fitted.channel, 100.0 * fitted.departures->residual_relative[k]));
    }
  }
  // If the residual of the image reaches its limit, the other values of the model mean little.
  return {
      judged("image residual", "% of the image", {o.max_residual_percent}, residual_advice(checked),
             residual),
      judged("light of shot", "% off the joint model",
             {o.max_power_percent, false, false, o.least_stds},
             "check whether aperture, exposure or LED current changed in this shot", power),
      judged("LED drift", "% over the shots", {o.max_drift_percent, false, false, 3.0},
             "let the LED warm up, or drive it with a constant current", drifts(checked, powers)),
      judged("light from elsewhere", "% of mean light",
             {o.max_even_percent, false, false, o.least_stds},
             "switch off every other lamp, close the blinds, or list a light of type ambient",
             even),
      judged("strength of light", "std off the rig's", {kMostPull},
             "check camera.responsivity_counts_mm2_sr_per_W_s, lights.intensity_W_per_sr and the "
             "exposure times",
             strength(checked))};
}

}  // namespace scattermeter::apps
