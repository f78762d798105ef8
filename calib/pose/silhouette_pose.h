// Camera pose from a silhouette combined with an independent pose.
#pragma once

#include <optional>

#include "calib/pose/edge_fit.h"
#include "calib/pose/pose.h"
#include "calib/pose/silhouette.h"
#include "core/camera/camera_model.h"

namespace scattermeter::calib {

// Without the pieces that stand apart from where the given pose puts them, by four robust
// deviations of all pieces' offsets from there: where a step between two bright faces lies near
// another edge, some may be a px off, and few lines give the silhouette alone no means to tell.
// Absent if there are none, or if more than a fifth of the pieces are.
std::optional<Silhouette> without_strays(const Silhouette& silhouette);

// Least squares of the silhouette's pieces alone, with the errors that find_silhouette() estimated,
// from its pose. distance_mm: about that of the body, for the prior that keeps the fit from
// diverging.
EdgeFit fit_alone(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                  double distance_mm);

// Joint least squares of the silhouette's pieces and the pose `prior`, without the consistency test
// of combine(); not converged if they fail.
EdgeFit fit_with_pose(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                      const PoseResult& prior);

// The combined estimate from a silhouette and an independent pose, in which their information adds.
// The frame of the covariance is that of PoseResult. The status is kNoConsensus when the two
// contradict each other (p below 1e-6 with six degrees of freedom), kIllConditioned when the fit
// fails. inlier and residuals_px remain those of `prior`; rms and worst of the result are those of
// the silhouette's pieces.
PoseResult combine(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                   const PoseResult& prior);

}  // namespace scattermeter::calib
