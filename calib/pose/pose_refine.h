// Least-squares pose from point pairs, in normalised coordinates.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/pose/pose.h"
#include "core/camera/lens.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// The pairs in the form that the solvers use: world points relative to their centroid, in units of
// their rms distance from it. Projection is independent of scale, so nothing is lost, and neither a
// world origin a kilometre away nor the choice of mm costs precision.
struct PoseScene {
  Lens lens;
  std::vector<Eigen::Vector3d> points;  // (world_mm - centroid_mm) / scale_mm
  std::vector<Eigen::Vector2d> image_px;
  std::vector<Eigen::Vector2d> rays;  // (X / Z, Y / Z) through image_px; NaN if there is none
  Eigen::Vector3d centroid_mm;
  double scale_mm;  // > 0: callers ensure at least two different points
};

PoseScene make_scene(const CameraIntrinsics& intrinsics, const std::vector<PointPair>& pairs);

// A pose in the scene's units: x_in_camera = rotation * point + center.
struct ScenePose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d center;  // the points' centroid in the camera frame, in units of scale_mm
};

Rigid3d camera_from_world(const PoseScene& scene, const ScenePose& pose);

// Projected - measured positions; NaN if there is no image.
std::vector<Eigen::Vector2d> residuals(const PoseScene& scene, const ScenePose& pose);

struct PoseFit {
  ScenePose pose;
  double sum_squares_px2 = 0;  // over the pairs used; infinite if one has no image at the start
  // J^T J in px^2 for the perturbation rotation -> exp([w]_x) rotation, center -> center + d:
  // about the centroid, where w and d are hardly correlated (about the camera they nearly
  // coincide).
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  bool converged = false;  // the remaining step is below 1e-6 standard deviations
};

// Levenberg-Marquardt over the pairs whose `use` is set, at most `max_iterations` steps.
PoseFit refine_pose(const PoseScene& scene, const std::vector<bool>& use, const ScenePose& start,
                    int max_iterations = 200);

// sum J^T J_lens over the pairs used: the derivative of the gradient J^T r by each lens parameter,
// with J as in PoseFit::information. lens: that of the scene.
PosePerLens gradient_per_lens_parameter(const PoseScene& scene, const std::vector<bool>& use,
                                        const ScenePose& pose, const LensParameters& lens);

// The (w, d) that leads from `from` to `to`: to.rotation = exp([w]_x) from.rotation.
Eigen::Matrix<double, 6, 1> pose_difference(const ScenePose& from, const ScenePose& to);

}  // namespace scattermeter::calib
