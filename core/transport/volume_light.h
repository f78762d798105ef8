// The image of a lit object by volume Monte Carlo.
#pragma once

#include <cstdint>
#include <vector>

#include "core/diffusion/dipole_image.h"
#include "core/mesh/patch_mesh.h"
#include "core/transport/path_tracer.h"

namespace scattermeter {

struct VolumeLightOptions {
  std::uint64_t seed = 1;
  std::int64_t paths = 1'000'000;  // in 64 blocks; at least one each
  PathPeers* peers = nullptr;      // processes that share the tracing; the digits are the same
};

struct VolumeLight {
  std::vector<double> l_at_nodes;  // of the field, W/mm^2 per W of the source's unit
  double median_relative_std = 0;  // Monte Carlo error of the mean l of a patch, over patches
  PathAudit audit;                 // of all blocks
};

// l (paper eq. 11) toward the world's camera at the nodes of a field on the patches: the scores'
// projection onto functions that are linear on each patch and continuous where patches share nodes
// (least squares over the surface; edge midpoints are the means of their corners). The error for
// smooth light is of second order in the patch size. Deterministic.
VolumeLight volume_radiosity(const SurfaceField& field, const PatchMesh& patches,
                             const PathWorld& world, const VolumeLightOptions& options);

// Groups of facets that share nodes: across edges that bend by less than 20 degrees, light is taken
// as continuous. Returns the number of each facet's group, from 0.
std::vector<int> smooth_parts(const TriangleMesh& mesh);

// Patch size for the above: 0.8 mean free paths, within 1/125 .. 1/40 of the object's size.
double volume_patch_size_mm(double mean_free_path_mm, double object_size_mm);

}  // namespace scattermeter
