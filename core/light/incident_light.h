// Light that enters each patch.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "core/light/led.h"
#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// A triangle of surface over which the transmitted irradiance is linear: a whole lit patch, or a
// lit part of a patch that a shadow edge crosses.
struct LitTriangle {
  std::array<Eigen::Vector3d, 3> corners_mm;
  std::array<double, 3>
      irradiance_sr_per_mm2;  // transmitted, at the corners, per W/sr of intensity
  int patch_idx;
};

// Integral of the irradiance over the triangle, sr.
double power_sr(const LitTriangle& triangle);

// The paper's c_k (eq. 12, with the patch area), per unit of on-axis intensity, and its density
// over the patches.
struct IncidentLight {
  std::vector<LitTriangle> lit;         // unlit surface is not included
  std::vector<double> patch_power_sr;   // c_k per W/sr: the integral of the transmitted irradiance
                                        // over patch k, mm^2 * sr/mm^2
  int shadow_edge_patches = 0;          // patches crossed by a shadow edge
  std::size_t shadow_rays = 0;          // shadow rays cast
  std::size_t shadow_rays_skipped = 0;  // saved because a convex body cannot shadow itself
};

struct IncidentLightOptions {
  int shadow_bisections =
      6;  // a patch on a shadow edge is cut into 2^n parts, each lit by its share
};

// With a radius, the LED is a disc: patches in a penumbra are bisected until the irradiance is
// linear on each part to 1e-3 of the full irradiance; the smallest parts get the mean over 16
// points. A shadow edge is detected where it separates the corners, the centre or the edge
// midpoints of a patch. Patches whose facet faces away from the LED are dark without a ray being
// cast.
IncidentLight illuminate(const PatchMesh& patches, const RayScene& scene, const Led& led,
                         double eta_int_over_ext, const IncidentLightOptions& options = {});

}  // namespace scattermeter
