// What share of the light below the surface leaves it towards a sample.
#pragma once

#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"
#include "core/view/sample_map.h"
#include "core/view/seen_surface.h"

namespace scattermeter {

// Ft(eta, w_o) of paper eq. 11 as samples see it. A sample whose neighbours see facets of other
// slants, which do not stand for a smooth surface (core/mesh/surface_normals.h), sees parts of
// several: it has the mean over its area, which is that of L_o where l is continuous across the
// edges.
class ExitTransmittance {
 public:
  // All arguments must outlive it.
  ExitTransmittance(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
                    const SeenSurface& surface, double eta_int_over_ext);

  // 0 .. 1. Precondition: the sample sees a patch.
  double of(int x, int y) const;

 private:
  double at_center(std::size_t i) const;
  // Whether a neighbour sees another facet with a transmittance that differs from `own`.
  bool mixed(int x, int y, double own) const;

  const RayGrid& rays_;
  const RayScene& scene_;
  const PatchMesh& patches_;
  const SeenSurface& surface_;
  double eta_;
};

}  // namespace scattermeter
