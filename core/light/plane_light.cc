#include "core/light/plane_light.h"

#include "core/light/plane_entry.h"
#include "core/light/plane_irradiance.h"

namespace scattermeter {

PlaneLight::PlaneLight(const Led& led, double z_mm, const Eigen::Array3d& albedo,
                       const Eigen::Array3d& albedo_std)
    : led_(led), z_mm_(z_mm), albedo_std_(albedo_std), power_(albedo * led.intensity_W_per_sr) {}

std::vector<IncidentLight> PlaneLight::illuminate(const PatchMesh& patches, const RayScene& scene,
                                                  double eta_int_over_ext, LightUse use) const {
  PlaneIrradianceOptions options;
  if (use == LightUse::kRender) {
    options.rings = 16;
    options.sectors = 64;
  }
  return {light_from_plane(
      patches, scene, z_mm_, eta_int_over_ext,
      [&](const Eigen::Vector3d& at) { return plane_irradiance_per_mm2(scene, led_, at); },
      options)};
}

std::unique_ptr<EntrySource> PlaneLight::entry(const RayScene& scene, double eta_int_over_ext,
                                               int /*channel*/) const {
  return plane_entry(scene, led_, {z_mm_, 1.0}, eta_int_over_ext);
}

std::optional<double> PlaneLight::patches_across(LightUse use) const {
  return use == LightUse::kRender ? 60.0 : 12.0;
}

std::vector<LightNuisance> PlaneLight::nuisances(const std::string& /*name*/,
                                                 std::size_t channel) const {
  const auto c = static_cast<Eigen::Index>(channel);
  if (!(albedo_std_[c] > 0.0)) return {};
  return {{"plane albedo", "surroundings", albedo_std_[c], {}, 0.0, led_.intensity_W_per_sr[c]}};
}

}  // namespace scattermeter
