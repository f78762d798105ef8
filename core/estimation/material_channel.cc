#include "core/estimation/material_channel.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/base/input_error.h"

namespace scattermeter {
namespace {

// A shot whose brightest patch exceeds its noise by fewer deviations than this is dark.
constexpr double kDarkSnr = 10.0;
// A shot with more than this share of its patches clipped is over-exposed as a whole.
constexpr double kClippedShare = 0.5;

}  // namespace

std::vector<MaterialChannel> material_channels(const Scene& scene,
                                               std::span<const ObservedShot> shots,
                                               const std::string& channels) {
  std::vector<MaterialChannel> out;
  for (const std::string& material : scene.materials()) {
    for (std::size_t c = 0; c < kRgb; ++c) {
      if (!channels.empty() && channels.find(kRgbName[c]) == std::string::npos) continue;
      MaterialChannel one{material, c, {}};
      for (const ObservedShot& shot : shots) {
        if (shot.stated->material != material) continue;
        const SceneObject& object = *shot.seen->object->stated;
        const double eta = object.eta_int_over_ext;
        if (!one.shots.empty() && eta != one.eta_int_over_ext) {
          throw InputError(scene.at(shot.stated->line) + ": shots.object",
                           fmt::format("material {} has eta {} here but {} in another shot",
                                       material, eta, one.eta_int_over_ext));
        }
        if (!one.shots.empty() && !(object.phase == one.phase)) {
          throw InputError(
              scene.at(shot.stated->line) + ": shots.object",
              fmt::format("material {} has another phase function in another shot", material));
        }
        one.eta_int_over_ext = eta;
        one.phase = object.phase;
        one.gamma_std = std::max(one.gamma_std, object.gamma_std);
        one.surface_alpha = std::max(one.surface_alpha, object.surface_alpha);
        if (object.surface_alpha > 0.0) {
          one.surface_alpha_std = std::max(one.surface_alpha_std, object.surface_alpha_std);
        }
        one.shots.push_back(&shot);
      }
      if (!one.shots.empty()) out.push_back(one);
    }
  }
  return out;
}

std::string shot_problem(const ObservedShot& shot, std::size_t channel) {
  const ChannelObservation& o = shot.observation.channel[channel];
  const char name = kRgbName[channel];
  const double rows = static_cast<double>(o.l.size());
  if (o.l.empty())
    return fmt::format("{}: no whole patch of the object is seen", shot.stated->file);
  if (static_cast<double>(o.rows_clipped) > kClippedShare * rows) {
    return fmt::format("{}: channel {} is clipped on {:.0f} % of the object (exposure {:g} s)",
                       shot.stated->file, name, 100.0 * static_cast<double>(o.rows_clipped) / rows,
                       shot.exposure_s);
  }
  if (o.brightest_snr < kDarkSnr) {
    return fmt::format(
        "{}: channel {} is dark, brightest patch {:.1f} counts above black, {:.2g} times its noise "
        "as camera.sensor states it",
        shot.stated->file, name, o.brightest_counts, o.brightest_snr);
  }
  const double noise = std::sqrt(o.noise_excess);
  if (o.brightest_snr < kDarkSnr * noise) {
    return fmt::format(
        "{}: channel {} is {:.2g} times as noisy as the rig states, its brightest patch only "
        "{:.2g} times as bright as its noise: see what the picture has besides the object, or set "
        "camera.sensor gain_e_per_count and read_noise_counts for this ISO",
        shot.stated->file, name, noise, o.brightest_snr / noise);
  }
  return "";
}

void apply_mesh_scale(const MaterialChannel& channel, Estimate& estimate) {
  double relative_std = 0.0, larger = 0.0;
  for (const ObservedShot* shot : channel.shots) {
    relative_std = std::max(relative_std, shot->size_relative_std());
    const std::string name = shot->seen->object->stated->piece_name() + ".size";
    for (const PriorPull& pull : estimate.pulls) {
      if (pull.name == name) larger += pull.offset / static_cast<double>(channel.shots.size());
    }
  }
  if (!(relative_std > 0.0)) return;
  Quantity& s = estimate.sigma_s_prime_per_mm;
  Quantity& a = estimate.sigma_a_per_mm;
  for (Quantity* q : {&s, &a}) {
    for (double* of : {&q->value, &q->std, &q->low95, &q->high95}) *of /= 1.0 + larger;
  }
  const double by_s = relative_std * s.value;
  const double by_a = relative_std * a.value;
  widen({"mesh scale", by_s, by_a}, by_s * by_a, estimate);
}

bool has_fitted_light(const Scene& scene, const MaterialChannel& channel) {
  return std::any_of(channel.shots.begin(), channel.shots.end(), [&](const ObservedShot* shot) {
    const std::vector<std::string>& names = shot->stated->lights;
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return scene.light(name)->is_fitted(); });
  });
}

double patch_size_mm(const MaterialChannel& channel) {
  double size_mm = 0.0;
  for (const ObservedShot* shot : channel.shots) {
    size_mm = std::max(size_mm, shot->seen->patches->patch_size_mm());
  }
  return size_mm;
}

}  // namespace scattermeter
