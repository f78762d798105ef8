// The camera's pose from a silhouette and an independent pose together.
#pragma once

#include "calib/pose/edge_fit.h"
#include "calib/pose/pose.h"
#include "calib/pose/silhouette.h"
#include "core/camera/camera_model.h"

namespace scattermeter::calib {

// Least squares of the silhouette's pieces and the pose `prior` together, which combine() judges;
// not converged where they fail.
EdgeFit fit_with_pose(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                      const PoseResult& prior);

// The pose that silhouette and another, independent one give together: informations add. The
// covariance's frame is that of PoseResult. Status kNoConsensus when the two contradict each other
// (p below 1e-6 with six degrees of freedom), kIllConditioned when the fit fails. inlier and
// residuals_px stay those of `prior`; rms and worst of the result are of the silhouette's pieces.
PoseResult combine(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                   const PoseResult& prior);

}  // namespace scattermeter::calib
