// Light of an environment that enters each patch.
#pragma once

#include <array>

#include "core/light/incident_light.h"
#include "core/light/probe_tree.h"
#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

struct EnvironmentLightOptions {
  // Error of the irradiance, relative to that of the unoccluded facet: that of the integral over
  // directions, and three times this for the interpolation between the corners of a lit triangle,
  // except where the shadow of a bright pixel ends.
  double tolerance = 1e-4;
  int sky_bisections = 4;     // for a patch over which the sky's light is not linear
  int shadow_bisections = 6;  // for a patch on the shadow edge of bright pixels
};

// Channels R, G, B, per W/(mm^2 sr) of a probe value of 1: patch powers in mm^2 sr, irradiances in
// sr. The integral of probe * cos * Ft(eta, cos) over all directions that the mesh does not block;
// deterministic, with the same digits for any number of threads. Facets with no part of the mesh in
// front of their plane need no rays; their irradiance is constant. Where both sky and bright pixels
// vary over a patch, its lit triangles overlap and their irradiances add. A hole or a bar that is
// narrower than 1/64 of the probe's width, as seen from the surface, may be missed.
std::array<IncidentLight, 3> illuminate(const PatchMesh& patches, const RayScene& scene,
                                        const ProbeTree& probe, double eta_int_over_ext,
                                        const EnvironmentLightOptions& options = {});

// Irradiance of an unoccluded surface, R, G, B, per W/(mm^2 sr) of a probe value of 1,
// sr.
Eigen::Array3d open_irradiance(const ProbeTree& probe, const Eigen::Vector3d& normal,
                               double eta_int_over_ext, double tolerance = 1e-4);

}  // namespace scattermeter
