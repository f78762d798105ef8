// Light that a diffuse plane sends onto the patches of an object above it.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "core/light/incident_light.h"
#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

struct PlaneIrradianceOptions {
  int rings = 8;  // of directions below the horizon, of equal solid angle
  int sectors = 32;
};

// Irradiance of the plane at a point of it, in any unit u per mm^2; called from several threads.
using OnPlane = std::function<double(const Eigen::Vector3d& on_plane_mm)>;

struct SurfacePoint {
  Eigen::Vector3d at_mm;
  Eigen::Vector3d normal;  // unit, outwards
};

// Transmitted irradiance, u per mm^2, of points of the mesh by a plane z = z_mm of albedo 1 that is
// lit by `irradiance`: see light_from_plane(). Points count as at least least_height_mm above the
// plane: one on the plane itself would see a single point of it.
std::vector<double> irradiance_from_plane(const std::vector<SurfacePoint>& points,
                                          const RayScene& scene, double z_mm,
                                          double least_height_mm, double eta_int_over_ext,
                                          const OnPlane& irradiance,
                                          const PlaneIrradianceOptions& options);

// Light of a plane z = z_mm of albedo 1 that is lit by `irradiance`: radiance irradiance / pi
// upwards, transmitted into each patch, in u, without what the mesh itself hides. Faces that lie on
// the plane get none. Summed over equal parts of the directions below the horizon, the same number
// at each corner of the patches, turned from corner to corner: relative error about 3e-3 where the
// irradiance is smooth, 2e-2 near the edge of a shadow (test: against paths). Deterministic.
IncidentLight light_from_plane(const PatchMesh& patches, const RayScene& scene, double z_mm,
                               double eta_int_over_ext, const OnPlane& irradiance,
                               const PlaneIrradianceOptions& options = {});

}  // namespace scattermeter
