// Least-squares pose over point pairs, in coordinates made for it.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "calib/pose/pose.h"
#include "core/camera/lens.h"
#include "core/camera/rigid3d.h"

namespace scattermeter::calib {

// The pairs as the solvers see them: world points about their centroid, in units of their rms
// distance from it. Projection knows no scale, so nothing is lost; and neither a world origin a
// kilometre away nor the choice of mm costs digits.
struct PoseScene {
  Lens lens;
  std::vector<Eigen::Vector3d> points;  // (world_mm - centroid_mm) / scale_mm
  std::vector<Eigen::Vector2d> image_px;
  std::vector<Eigen::Vector2d> rays;  // (X / Z, Y / Z) through image_px; NaN if there is none
  Eigen::Vector3d centroid_mm;
  double scale_mm;  // > 0: callers see to points at two places at least
};

PoseScene make_scene(const CameraIntrinsics& intrinsics, const std::vector<PointPair>& pairs);

// A pose in the scene's units: x_in_camera = rotation * point + center.
struct ScenePose {
  Eigen::Matrix3d rotation;
  Eigen::Vector3d center;  // the points' centroid in the camera frame, in units of scale_mm
};

Rigid3d camera_from_world(const PoseScene& scene, const ScenePose& pose);

// Projected - given, NaN where there is no image.
std::vector<Eigen::Vector2d> residuals(const PoseScene& scene, const ScenePose& pose);

struct PoseFit {
  ScenePose pose;
  double sum_squares_px2 = 0;  // over the pairs used; infinite where the start has no image of one
  // J^T J in px^2 for the perturbation rotation -> exp([w]_x) rotation, center -> center + d:
  // about the centroid, where w and d hardly mix (about the camera they nearly coincide).
  Eigen::Matrix<double, 6, 6> information = Eigen::Matrix<double, 6, 6>::Zero();
  bool converged = false;  // the step left is below 1e-6 standard deviations
};

// Levenberg-Marquardt over the pairs whose `use` is set, at most `max_iterations` steps.
PoseFit refine_pose(const PoseScene& scene, const std::vector<bool>& use, const ScenePose& start,
                    int max_iterations = 200);

// sum J^T J_lens over the pairs used: how the gradient J^T r grows with each lens parameter, J as
// of PoseFit::information. lens: the scene's.
PosePerLens gradient_per_lens_parameter(const PoseScene& scene, const std::vector<bool>& use,
                                        const ScenePose& pose, const LensParameters& lens);

// (w, d) that leads from `from` to `to`: to.rotation = exp([w]_x) from.rotation.
Eigen::Matrix<double, 6, 1> pose_difference(const ScenePose& from, const ScenePose& to);

}  // namespace scattermeter::calib
