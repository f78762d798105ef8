// Light of an LED by way of a diffuse plane, as a light of its own.
#pragma once

#include "core/light/diffuse_plane.h"
#include "core/light/led.h"
#include "core/light/light.h"

namespace scattermeter {

// What the plane z = z_mm reflects onto an object above it while the LED lights it, in the object's
// shadow (an LED with a radius counts as a point in illuminate()). Its power is the LED's intensity
// times the plane's albedo; the light reaches the object once. The other uncertainties of the setup
// are negligible for it.
class PlaneLight final : public Light {
 public:
  PlaneLight() = default;
  // albedo, albedo_std: R, G, B, 0 .. 1.
  PlaneLight(const Led& led, double z_mm, const Eigen::Array3d& albedo,
             const Eigen::Array3d& albedo_std);

  std::size_t channels() const override { return 1; }
  const Eigen::Array3d& power() const override { return power_; }
  std::vector<IncidentLight> illuminate(const PatchMesh& patches, const RayScene& scene,
                                        double eta_int_over_ext, LightUse use) const override;
  std::unique_ptr<EntrySource> entry(const RayScene& scene, double eta_int_over_ext,
                                     int channel) const override;
  std::optional<double> patches_across(LightUse use) const override;
  bool is_fitted() const override { return true; }
  // The albedo, shared by all LEDs' light by way of the plane.
  std::vector<LightNuisance> nuisances(const std::string& name, std::size_t channel) const override;

 private:
  Led led_;
  double z_mm_ = 0;
  Eigen::Array3d albedo_std_ = Eigen::Array3d::Zero();
  Eigen::Array3d power_ = Eigen::Array3d::Zero();
};

}  // namespace scattermeter
