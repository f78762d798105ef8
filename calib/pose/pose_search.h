// Robust search for a pose among point pairs with outliers.
#pragma once

#include <vector>

#include "calib/pose/pose_refine.h"

namespace scattermeter::calib {

struct PoseConsensus {
  PoseFit fit;               // over the inliers
  std::vector<bool> inlier;  // one per pair; all false when no hypothesis could be made
  int inliers = 0;
};

// The pose with the least sum over pairs of min(|residual|^2, inlier_px^2) (MSAC: P. Torr and
// A. Zisserman, "MLESAC", 2000) among hypotheses from three pairs each (P3P), each good one refined
// over its inliers before it is compared (LO-RANSAC: O. Chum, J. Matas, J. Kittler, "Locally
// optimized RANSAC", 2003). All triples are tried if there are few, otherwise random ones with a
// fixed seed. Deterministic.
PoseConsensus find_consensus(const PoseScene& scene, double inlier_px, double confidence);

// Up to four poses that map three pairs exactly (none for a degenerate triple).
std::vector<ScenePose> poses_from_three(const PoseScene& scene, const std::vector<size_t>& triple);

}  // namespace scattermeter::calib
