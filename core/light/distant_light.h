// A light probe as a light of the scene.
#pragma once

#include <functional>

#include "core/light/light.h"
#include "core/light/probe_tree.h"

namespace scattermeter {

// Distant light given by the picture of a probe. Copies share the picture, which is read once.
class DistantLight final : public Light {
 public:
  DistantLight() = default;
  // read: returns the picture with its projection and orientation; called when the light is first
  // needed; may throw InputError.
  explicit DistantLight(std::function<Environment()> read);

  Eigen::Array3d radiance_W_per_mm2_sr = Eigen::Array3d::Ones();  // of a probe value of 1
  double radiance_relative_std = 0;                               // common to the three channels

  const ProbeTree& probe() const;

  std::size_t channels() const override { return 3; }
  const Eigen::Array3d& power() const override { return radiance_W_per_mm2_sr; }
  void open() const override { probe(); }
  std::vector<IncidentLight> illuminate(const PatchMesh& patches, const RayScene& scene,
                                        double eta_int_over_ext, LightUse use) const override;
  std::unique_ptr<EntrySource> entry(const RayScene& scene, double eta_int_over_ext,
                                     int channel) const override;
  Eigen::Array3d open_irradiance_W_per_mm2(const Eigen::Vector3d& normal) const override;
  std::optional<double> patches_across(LightUse use) const override;
  std::vector<LightNuisance> nuisances(const std::string& name, std::size_t channel) const override;

 private:
  struct Picture;
  std::shared_ptr<Picture> picture_;
};

}  // namespace scattermeter
