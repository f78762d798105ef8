// The mapping of camera samples to the patches that they see.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/exit_site.h"
#include "core/mesh/patch_mesh.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// Rays through the pixel centres of a rectangle of the frame.
struct RayGrid {
  Eigen::Vector3d origin_in_world_mm = Eigen::Vector3d::Zero();  // the camera's centre
  int x0 = 0, y0 = 0, width = 0, height = 0;                     // px
  std::vector<Eigen::Vector3f> directions_in_world;  // row by row, any length; NaN: no ray
};

// First hit of one ray, with what pictures and maps need of it.
struct PixelHit {
  std::int32_t facet_idx = -1;  // -1: background
  PatchPoint at;                // the patch and the position in it
  double distance_mm = 0;
  double cos_theta = 0;  // between the direction back to the camera and the normal; > 0
};

// The cosine of a first hit, from the ray's direction (of any length): between the direction back
// to the camera and the normal of the smooth surface that the facets may stand for, at least
// kLeastCosine. 0: background, or the inner side of a facet, through a pinhole of rounding.
inline constexpr double kLeastCosine = 1e-3;
double cosine_of(const RayHit& hit, const PatchMesh& patches, const Eigen::Vector3d& origin_mm,
                 const Eigen::Vector3d& direction);
PixelHit trace_pixel(const RayScene& scene, const PatchMesh& patches,
                     const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction);

struct SampleMapOptions {
  int guard_px = 2;  // samples this near a silhouette, a step in depth or a crease are left out
  double min_coverage = 0.8;  // patches with a smaller visible, unguarded share have no row
  // Samples this near a convex crease or the body's own silhouette, along the surface, are left out
  // too: there, the edges of the piece may be cut back from those of the mesh.
  double edge_reach_mm = 0;
  // Samples that see the surface at a smaller cosine to its normal are left out too: what they see
  // depends on where exactly the object stands. In [0, 1).
  double least_cosine = 0;
};

// The visible patches, each a row of the linear system, and the samples of each row.
struct SampleMap {
  int x0 = 0, y0 = 0, width = 0, height = 0;
  std::vector<std::int32_t> row_of_sample;  // -1: background, guarded or in no row
  // pi / Ft(eta, w_o): l = this * L_o (paper eq. 11); 0: in no row.
  std::vector<float> pi_over_transmittance;
  std::vector<int> patch_of_row;
  std::vector<SampleSpread> samples;  // of each row: surface points, world
  // Of rows with guarded samples: those of each quarter of the patch; of others none.
  std::vector<std::vector<SampleSpread>> of_quarters;
  std::vector<double> coverage;             // visible share of each row's patch
  std::vector<std::size_t> guarded_of_row;  // samples on the row's patch that are left out
  std::vector<std::vector<std::int32_t>> adjacent_rows;  // of each row (core/view/adjacent_rows.h)
  std::size_t samples_on_object = 0;
  std::size_t samples_guarded = 0;
  std::size_t patches_partly_seen = 0;  // seen, but for less than min_coverage
};

SampleMap map_samples(const RayGrid& rays, const RayScene& scene, const PatchMesh& patches,
                      double eta_int_over_ext, const SampleMapOptions& options = {});

}  // namespace scattermeter
