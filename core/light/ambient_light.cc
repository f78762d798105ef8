#include "core/light/ambient_light.h"

#include <vector>

#include "core/light/environment.h"
#include "core/light/environment_light.h"
#include "core/light/probe_projection.h"
#include "core/light/probe_tree.h"

namespace scattermeter {
namespace {

constexpr int kProbeHeight = 64;

// Of 3 degrees.
Environment probe_of(const std::vector<float>& radiance) {
  Environment out;
  out.width_px = 2 * kProbeHeight;
  out.height_px = kProbeHeight;
  out.radiance = radiance;
  return out;
}

// Radiance 1 from everywhere: what is above a pixel is summed once, what is below again for every
// facet.
const ProbeTree& even_probe() {
  static const ProbeTree even(
      probe_of(std::vector<float>(std::size_t{3} * 2 * kProbeHeight * kProbeHeight, 1.0F)));
  return even;
}

// Radiance 1 + w_x, 1 + w_y, 1 + w_z from the direction w.
const ProbeTree& probe_of_axes() {
  static const ProbeTree axes(
      [] {
        const ProbeMap map(ProbeProjection::kEquirectangular, 2 * kProbeHeight, kProbeHeight);
        std::vector<float> radiance;
        for (int y = 0; y < kProbeHeight; ++y) {
          for (int x = 0; x < 2 * kProbeHeight; ++x) {
            const Eigen::Vector3d w = map.direction(x + 0.5, y + 0.5);
            for (const double along : w) radiance.push_back(static_cast<float>(1.0 + along));
          }
        }
        return probe_of(radiance);
      }(),
      {.is_linear = true});
  return axes;
}

EnvironmentLightOptions options_for(LightUse use) {
  EnvironmentLightOptions options;
  if (use == LightUse::kMeasure) {
    options.tolerance = 3e-4;
    options.sky_bisections = 3;
  } else if (use == LightUse::kBudget) {
    options.tolerance = 1e-2;
    options.sky_bisections = 1;
  }
  return options;
}

}  // namespace

std::vector<IncidentLight> AmbientLight::illuminate(const PatchMesh& patches, const RayScene& scene,
                                                    double eta_int_over_ext, LightUse use) const {
  return {scattermeter::illuminate(patches, scene, even_probe(), eta_int_over_ext,
                                   options_for(use))[0]};
}

std::array<IncidentLight, 3> illuminate_more_from_axes(const PatchMesh& patches,
                                                       const RayScene& scene,
                                                       double eta_int_over_ext) {
  return illuminate(patches, scene, probe_of_axes(), eta_int_over_ext,
                    options_for(LightUse::kBudget));
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
