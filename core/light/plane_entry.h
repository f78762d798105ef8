// Sampling of the light that a diffuse plane reflects onto a body.
#pragma once

#include <memory>

#include "core/light/diffuse_plane.h"
#include "core/light/entry_source.h"
#include "core/light/led.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// Irradiance of the plane at a point of it by the LED, per unit of on-axis intensity, sr/mm^2, in
// the shadow of the mesh. A disc counts as a point at its centre.
double plane_irradiance_per_mm2(const RayScene& scene, const Led& led,
                                const Eigen::Vector3d& on_plane_mm);

// Light of an LED, a point or a disc, that the plane reflects once onto the mesh, which lies above
// it: radiance albedo E / pi, with the mesh's shadow on the plane. In the unit of led_entry(); 0
// for an LED below the plane. The scene must outlive the source.
std::unique_ptr<EntrySource> plane_entry(const RayScene& scene, const Led& led,
                                         const DiffusePlane& plane, double eta_int_over_ext);

// Both light that comes straight from the LED (led_entry()) and light that the plane reflects, as
// often as they have power. For an albedo of 0 it is led_entry(), in every digit.
std::unique_ptr<EntrySource> led_entry_above(const RayScene& scene, const Led& led,
                                             const DiffusePlane& plane, double eta_int_over_ext);

}  // namespace scattermeter
