// The interface of every kind of light: what estimation, simulation and planning need to know of
// it.
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

// One quantity that a light is known by only to a standard deviation, as the same light with that
// quantity changed by `step`.
struct LightChange {
  std::shared_ptr<const Light> changed;
  double step = 0;
};

// An independent error of a light. With dl/dq_k the derivative of the image by the quantity of the
// k-th LightChange, per unit of the light's power, and l the image per unit of power, the error
// changes the image by
//   std * (power * (sum_k of_change[k] dl/dq_k + of_power * l) + of_unit_power * l).
struct LightNuisance {
  std::string name;   // unique in the scene; lights with a nuisance of one name share it
  std::string group;  // in the budget
  double std = 0;
  Eigen::VectorXd of_change;  // as many as Light::changes(), or none
  double of_power = 0;
  double of_unit_power = 0;
};

// What the light is wanted for.
enum class LightUse {
  kMeasure,  // its share in a fit
  kRender,   // truth for a simulated picture: finer where the two differ
};

class Light {
 public:
  virtual ~Light() = default;

  // Channels that differ in where the light goes: 3 (R, G, B), or 1 for all of them.
  virtual std::size_t channels() const = 0;
  // What the light's IncidentLight counts in, R G B: an LED's intensity on its axis, W/sr, or the
  // radiance of a probe value of 1, W/(mm^2 sr).
  virtual const Eigen::Array3d& power() const = 0;

  // Reads what the light is made of (the picture of a probe) if that has not been done yet; the
  // functions below do so by themselves. Throws InputError.
  virtual void open() const {}

  // The light that enters each patch, per unit of power(): channels() entries. Same digits for any
  // number of threads.
  virtual std::vector<IncidentLight> illuminate(const PatchMesh& patches, const RayScene& scene,
                                                double eta_int_over_ext, LightUse use) const = 0;
  // Where paths of this light start on an object, per unit of power(); channel 0 R, 1 G, 2 B. The
  // light and the scene must outlive it.
  virtual std::unique_ptr<EntrySource> entry(const RayScene& scene, double eta_int_over_ext,
                                             int channel) const = 0;
  // Irradiance, W/mm^2, R G B, of a surface with nothing before it by light from far away; 0 for
  // light from a position.
  virtual Eigen::Array3d open_irradiance_W_per_mm2(const Eigen::Vector3d& /*normal*/) const {
    return Eigen::Array3d::Zero();
  }

  // Position of the light, world, mm; empty for light from far away.
  virtual std::optional<Eigen::Vector3d> position_mm() const { return std::nullopt; }
  // How many patches across an object are enough for light that is smooth on it; empty: as fine as
  // the object's own.
  virtual std::optional<double> patches_across(LightUse /*use*/) const { return std::nullopt; }
  // True for a small light that is fitted along with the material: what else is uncertain of the
  // rig does not matter to it.
  virtual bool is_fitted() const { return false; }

  // The quantities that are known only to a standard deviation; steps fit for an object with its
  // centre here.
  virtual std::vector<LightChange> changes(const Eigen::Vector3d& /*object_center_mm*/) const {
    return {};
  }
  // The independent errors of one channel (0 R, 1 G, 2 B); `name` is the light's in the scene.
  virtual std::vector<LightNuisance> nuisances(const std::string& name,
                                               std::size_t channel) const = 0;
};

}  // namespace scattermeter
