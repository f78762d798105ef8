// An LED as a light of the scene.
#pragma once

#include <array>
#include <optional>

#include "core/light/led.h"
#include "core/light/led_uncertainty.h"
#include "core/light/light.h"

namespace scattermeter {

struct LedLight final : Light {
  Led led;
  double position_std_mm = 0;  // in each coordinate
  double axis_std_rad = 0;     // in each of two directions
  double exponent_std = 0;
  double intensity_relative_std = 0;  // common to the three channels
  // From `calibrate led`: replaces the four deviations above.
  std::optional<LedUncertainty> calibrated;
  // With a calibrated intensity: the responsivity (counts mm^2 sr/(W s), R G B) for which it was
  // calibrated.
  std::optional<std::array<double, 3>> calibrated_for;
  // Whether a calibration of radiance corrected the shots that it was calibrated with, if known.
  std::optional<bool> radiance_corrected;

  // The LED as the rig states it, about which the deviations are, where `led` is another one: that
  // which the shots show.
  std::optional<Led> stated;

  // Whether changes() begin with those of the position, and have those of axis and exponent.
  bool moves() const { return calibrated || position_std_mm > 0.0; }
  bool turns() const { return calibrated || axis_std_rad > 0.0; }
  bool spreads() const { return calibrated || exponent_std > 0.0; }
  // Puts `led` so far from the stated one, as displacement() tells it.
  void displace(const Eigen::VectorXd& by);

  std::size_t channels() const override { return 1; }
  const Eigen::Array3d& power() const override { return led.intensity_W_per_sr; }
  std::vector<IncidentLight> illuminate(const PatchMesh& patches, const RayScene& scene,
                                        double eta_int_over_ext, LightUse use) const override;
  std::unique_ptr<EntrySource> entry(const RayScene& scene, double eta_int_over_ext,
                                     int channel) const override;
  std::optional<Eigen::Vector3d> position_mm() const override { return led.position_mm; }
  std::vector<LightChange> changes(const Eigen::Vector3d& object_center_mm) const override;
  Eigen::VectorXd displacement() const override;
  // Position, exponent and power separately; with a calibration, seven independent combinations of
  // these and the axis ("LED calibration"), and one shared by all LEDs calibrated with the same
  // white plane.
  std::vector<LightNuisance> nuisances(const std::string& name, std::size_t channel) const override;

 private:
  const Led& about() const { return stated ? *stated : led; }
  // Unit vectors across the stated axis.
  std::array<Eigen::Vector3d, 2> across() const;
  // The axis, as long as its component along the stated one is 1: axes then add up.
  Eigen::Vector3d long_axis() const;
};

}  // namespace scattermeter
