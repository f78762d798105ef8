// Light of an LED that a rough surface reflects to the camera.
#pragma once

#include <Eigen/Core>

#include "core/light/led.h"
#include "core/material/rough_boundary.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// As l, pi L_o / Ft (RoughBoundary::smooth_transmittance()), per unit of the LED's on-axis
// intensity, sr/mm^2: what L_o has from the surface itself, by a single microfacet
// (RoughBoundary::reflection_per_sr()). A disc counts as a point at its centre. 0 in shadow.
double gloss_per_mm2(const RoughBoundary& boundary, const RayScene& scene, const Led& led,
                     const Eigen::Vector3d& at_mm, const Eigen::Vector3d& normal,
                     const Eigen::Vector3d& camera_mm);

}  // namespace scattermeter
