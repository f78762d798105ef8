#include "core/light/ambient_light.h"

#include "core/light/environment_light.h"
#include "core/light/probe_tree.h"

namespace scattermeter {
namespace {

// Radiance 1 from everywhere, in pixels of 3 degrees: what is above a pixel is summed once, what is
// below again for every facet.
const ProbeTree& even_probe() {
  static const ProbeTree even([] {
    constexpr int kHeight = 64;
    Environment out;
    out.width_px = 2 * kHeight;
    out.height_px = kHeight;
    out.radiance.assign(std::size_t{3} * 2 * kHeight * kHeight, 1.0F);
    return out;
  }());
  return even;
}

}  // namespace

std::vector<IncidentLight> AmbientLight::illuminate(const PatchMesh& patches, const RayScene& scene,
                                                    double eta_int_over_ext, LightUse use) const {
  EnvironmentLightOptions options;
  if (use == LightUse::kMeasure) {
    options.tolerance = 3e-4;
    options.sky_bisections = 3;
  } else if (use == LightUse::kBudget) {
    options.tolerance = 1e-2;
    options.sky_bisections = 1;
  }
  return {scattermeter::illuminate(patches, scene, even_probe(), eta_int_over_ext, options)[0]};
}

std::unique_ptr<EntrySource> AmbientLight::entry(const RayScene& scene, double eta_int_over_ext,
                                                 int channel) const {
  return environment_entry(scene, even_probe().environment(), channel, eta_int_over_ext);
}

Eigen::Array3d AmbientLight::open_irradiance_W_per_mm2(const Eigen::Vector3d& normal) const {
  return radiance_W_per_mm2_sr * open_irradiance(even_probe(), normal, 1.0);
}

std::optional<double> AmbientLight::patches_across(LightUse use) const {
  // A small, smooth addition to a fit: coarse patches suffice.
  return use == LightUse::kRender ? 60.0 : 24.0;
}

std::vector<LightNuisance> AmbientLight::nuisances(const std::string& name,
                                                   std::size_t channel) const {
  const double std = radiance_std_W_per_mm2_sr[static_cast<Eigen::Index>(channel)];
  if (!(std > 0.0)) return {};
  return {{name + ".ambient", "ambient", std, {}, 0.0, 1.0}};
}

}  // namespace scattermeter
