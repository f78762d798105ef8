#include "core/scene/lit_objects.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include <fmt/core.h>

#include "core/base/input_error.h"

namespace scattermeter {

const PatchMesh& patches_for(const Light& light, LightUse use, const ObjectScene& object,
                             const PatchMesh& patches, std::optional<PatchMesh>& coarse) {
  const auto across = light.patches_across(use);
  if (!across) return patches;
  return coarse.emplace(object.mesh(),
                        std::max(patches.patch_size_mm(), object.size_mm() / *across));
}

LitObjects::LitObjects(const Scene& scene, const ObjectScenes& objects,
                       std::optional<double> patch_size_mm, double distance_to_camera_mm)
    : scene_(scene), objects_(objects) {
  for (const SceneShot& shot : scene.shots) {
    for (const std::string& name : shot.lights) scene.light(name)->open();
  }
  for (const auto& [name, object] : objects) {
    // With fewer than about six samples across a patch, its mean depends on where they happen to
    // be.
    const double samples_mm = 8.0 * distance_to_camera_mm / scene.camera.intrinsics.fx_px;
    const double chosen_mm = std::max(object.size_mm() / 50.0, samples_mm);
    const double size_mm = patch_size_mm.value_or(object.stated->patch_size_mm.value_or(chosen_mm));
    const std::string field =
        scene.at(object.stated->line) + ": objects." + name + ".patch_size_mm";
    if (size_mm > object.size_mm()) {
      throw InputError(field, fmt::format("{:.4g} mm is larger than the object, {:.4g} mm", size_mm,
                                          object.size_mm()));
    }
    try {
      patches_[name] = std::make_unique<PatchMesh>(object.mesh(), size_mm);
    } catch (const std::length_error& e) {
      throw InputError(field, e.what());
    }
  }
}

const IncidentLight& LitObjects::light_on_patches(const std::string& object,
                                                  const SceneLight& light, std::size_t channel) {
  const ObjectScene& lit = objects_.at(object);
  std::optional<PatchMesh> coarse;
  return light_on(object, light, channel,
                  patches_for(*light, LightUse::kMeasure, lit, patches(object), coarse),
                  lit.stated->eta_int_over_ext);
}

bool LitObjects::reaches(const std::string& object, const std::string& name, std::size_t channel) {
  const SceneLight& light = scene_.light(name);
  return !light->position_mm() || !light_on_patches(object, light, channel).lit.empty();
}

const IncidentLight& LitObjects::light(const std::string& object, const std::string& name,
                                       std::size_t channel) {
  const SceneLight& light = scene_.light(name);
  if (!reaches(object, name, channel)) {
    throw InputError(
        scene_.at(light.line) + ": lights." + name,
        "the LED illuminates no part of object " + object + " (check position_mm and axis)");
  }
  return light_on_patches(object, light, channel);
}

const IncidentLight& LitObjects::light_on(const std::string& object, const SceneLight& light,
                                          std::size_t channel, const PatchMesh& patches,
                                          double eta_int_over_ext) {
  const auto [it, is_new] =
      lights_.try_emplace({object, light.name, patches.patch_size_mm(), eta_int_over_ext});
  if (is_new) {
    it->second =
        light->illuminate(patches, *objects_.at(object).rays, eta_int_over_ext, LightUse::kMeasure);
  }
  return it->second[channel];
}

std::vector<const IncidentLight*> LitObjects::lights_so_far() const {
  std::vector<const IncidentLight*> out;
  for (const auto& [key, channels] : lights_) {
    for (const IncidentLight& light : channels) out.push_back(&light);
  }
  return out;
}

double LitObjects::smallest_patch_mm() const {
  double smallest = patches_.begin()->second->patch_size_mm();
  for (const auto& [name, patches] : patches_) {
    smallest = std::min(smallest, patches->patch_size_mm());
  }
  return smallest;
}

double LitObjects::longest_distance_mm() const {
  double longest = 0.0;
  for (const auto& [name, object] : objects_) longest = std::max(longest, object.diagonal_mm());
  return longest;
}

}  // namespace scattermeter
