// Uniform light from all directions, whose radiance is fitted along with the material within its
// prior.
#pragma once

#include <array>

#include "core/light/light.h"

namespace scattermeter {

struct AmbientLight final : Light {
  Eigen::Array3d radiance_W_per_mm2_sr = Eigen::Array3d::Zero();
  Eigen::Array3d radiance_std_W_per_mm2_sr = Eigen::Array3d::Zero();  // infinite: free

  std::size_t channels() const override { return 1; }
  const Eigen::Array3d& power() const override { return radiance_W_per_mm2_sr; }
  std::vector<IncidentLight> illuminate(const PatchMesh& patches, const RayScene& scene,
                                        double eta_int_over_ext, LightUse use) const override;
  std::unique_ptr<EntrySource> entry(const RayScene& scene, double eta_int_over_ext,
                                     int channel) const override;
  Eigen::Array3d open_irradiance_W_per_mm2(const Eigen::Vector3d& normal) const override;
  std::optional<double> patches_across(LightUse use) const override;
  bool is_fitted() const override { return true; }
  std::vector<LightNuisance> nuisances(const std::string& name, std::size_t channel) const override;
};

// Light of radiance 1 + w_k from the direction w, k = x, y, z in the world, for a budget.
std::array<IncidentLight, 3> illuminate_more_from_axes(const PatchMesh& patches,
                                                       const RayScene& scene,
                                                       double eta_int_over_ext);

}  // namespace scattermeter
