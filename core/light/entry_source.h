// Sampling of the light that enters a body.
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "core/base/random_stream.h"
#include "core/light/environment.h"
#include "core/light/led.h"
#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

struct Entry {
  Eigen::Vector3d position_mm;  // on the surface
  Eigen::Vector3d direction;    // of flight, behind it
  double power = 0;             // represented by this sample
  // Of the surface there, outwards; zero for a beam, which starts behind it.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
};

// The mean power over all samples is the transmitted power, in the units of IncidentLight:
// sr per W/sr of an LED, mm^2 sr per W/(mm^2 sr) of a probe.
class EntrySource {
 public:
  virtual ~EntrySource() = default;
  // `stratum`: uniform over (0, 1); neighbouring values give neighbouring positions on the surface.
  // Empty: a sample without power (in shadow).
  virtual std::optional<Entry> sample(double stratum, RandomStream& random) const = 0;
};

// Light of an LED, a point or a disc of its radius, on all of the mesh that it reaches. The scene
// must outlive the source, as must the environment below.
std::unique_ptr<EntrySource> led_entry(const RayScene& scene, const Led& led,
                                       double eta_int_over_ext);

// Light of one channel (0 R, 1 G, 2 B) of an environment.
std::unique_ptr<EntrySource> environment_entry(const RayScene& scene,
                                               const Environment& environment, int channel,
                                               double eta_int_over_ext);

// A collimated beam of power 1 just inside the surface: it starts at a point on the surface, or is
// spread evenly over a parallelogram on it, with one direction of flight inside.
struct Beam {
  Eigen::Vector3d corner_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d side1_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d side2_mm = Eigen::Vector3d::Zero();
  Eigen::Vector3d direction = -Eigen::Vector3d::UnitZ();
};
std::unique_ptr<EntrySource> beam_entry(const Beam& beam);

}  // namespace scattermeter
