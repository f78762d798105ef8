// The interface of every kind of light, as estimation, simulation and planning use it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/light/entry_source.h"
#include "core/light/incident_light.h"
#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

class Light;

// A light with one of its uncertain quantities changed by `step`.
struct LightChange {
  std::shared_ptr<const Light> changed;
  double step = 0;
};

// An independent error of a light. With dl/dq_k the derivative of the image by the quantity of the
// k-th LightChange, per unit of the light's power, and l the image per unit of power, the error
// changes the image by
//   std * (power * (sum_k of_change[k] dl/dq_k + of_power * l) + of_unit_power * l).
struct LightNuisance {
  std::string name;   // unique in the scene; lights that use the same name share the nuisance
  std::string group;  // its line in the budget
  double std = 0;
  Eigen::VectorXd of_change;  // as many as Light::changes(), or none
  double of_power = 0;
  double of_unit_power = 0;
};

// The purpose for which the light is computed.
enum class LightUse {
  kMeasure,  // for a fit
  kBudget,   // for an uncertainty: 1 % suffices
  kRender,   // for a simulated picture: finer where the two differ
};

class Light {
 public:
  virtual ~Light() = default;

  // Number of different distributions of the light: 3 (R, G, B), or 1 for all channels.
  virtual std::size_t channels() const = 0;
  // The unit of the light's IncidentLight, R G B: an LED's on-axis intensity, W/sr, or the radiance
  // of a probe value of 1, W/(mm^2 sr).
  virtual const Eigen::Array3d& power() const = 0;

  // Reads the light's data (the picture of a probe) unless already read; the functions below do so
  // themselves. Throws InputError.
  virtual void open() const {}

  // The light that enters each patch, per unit of power(): channels() entries. The same digits for
  // any number of threads.
  virtual std::vector<IncidentLight> illuminate(const PatchMesh& patches, const RayScene& scene,
                                                double eta_int_over_ext, LightUse use) const = 0;
  // Source of this light's paths into an object, per unit of power(); channel 0 R, 1 G, 2 B. The
  // light and the scene must outlive it.
  virtual std::unique_ptr<EntrySource> entry(const RayScene& scene, double eta_int_over_ext,
                                             int channel) const = 0;
  // Irradiance, W/mm^2, R G B, of an unoccluded surface under distant light; 0 for a light at a
  // finite distance.
  virtual Eigen::Array3d open_irradiance_W_per_mm2(const Eigen::Vector3d& /*normal*/) const {
    return Eigen::Array3d::Zero();
  }

  // Position of the light, world, mm; empty for distant light.
  virtual std::optional<Eigen::Vector3d> position_mm() const { return std::nullopt; }
  // Number of patches across an object that suffices if the light is smooth on it; empty: as fine
  // as the object's own patches.
  virtual std::optional<double> patches_across(LightUse /*use*/) const { return std::nullopt; }
  // True for a weak light that is fitted along with the material: the other uncertainties of the
  // setup are negligible for it.
  virtual bool is_fitted() const { return false; }

  // The light with each of its uncertain quantities changed; the steps suit an object with this
  // centre.
  virtual std::vector<LightChange> changes(const Eigen::Vector3d& /*object_center_mm*/) const {
    return {};
  }
  // From the light as it is stated, about which its errors are, to this one, by the quantities of
  // changes(), in their units; empty: it is the stated one.
  virtual Eigen::VectorXd displacement() const { return {}; }
  // The independent errors of one channel (0 R, 1 G, 2 B); `name`: of the light in the scene.
  virtual std::vector<LightNuisance> nuisances(const std::string& name,
                                               std::size_t channel) const = 0;
};

}  // namespace scattermeter
