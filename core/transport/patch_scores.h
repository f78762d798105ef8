// Light toward the camera by patch, with the moments needed for re-weighting to another material.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/mesh/patch_mesh.h"
#include "core/transport/path_blocks.h"

namespace scattermeter {

// Sums over the camera scores of a patch: of weight w, w * scatterings and w * length (mm). The
// first estimates the integral of l over the patch, in the source's unit; its derivatives by
// log(sigma_s) (sigma_a fixed) and sigma_a follow as sum(w n) - sigma_s sum(w L) and -sum(w L).
struct PatchScores {
  std::vector<Eigen::Vector3d> mean;        // by patch, over the blocks
  std::vector<Eigen::Matrix3d> covariance;  // of that mean, from the spread of the blocks
  PathAudit audit;                          // mean per block; counts are totals
  int blocks = 0;
};

// Traces blocks first .. end - 1 (end - first >= 2, else std::invalid_argument). Blocks are
// independent and the same whenever they are traced: disjoint ranges give independent estimates.
// Patches lie on the mesh of the world's boundary; the world has a camera. Deterministic.
PatchScores patch_scores(const PatchMesh& patches, const PathWorld& world,
                         const PathOptions& options, int first, int end);

// The patch of a point of a facet, and where on it.
PatchPoint patch_of(const PatchMesh& patches, const TriangleMesh& mesh, int facet_idx,
                    const Eigen::Vector3d& point_mm);

}  // namespace scattermeter
