#include "calib/pose/pose_ambiguity.h"

#include <algorithm>
#include <cmath>

#include "calib/pose/pose_search.h"
#include "core/base/dense_solve.h"

namespace scattermeter::calib {
namespace {

// With d the line of sight and n the normal of the best plane through the points: a reflection at
// the plane normal to d maps x_in_camera - center to its depth-reversed counterpart, a reflection
// at the plane of the points leaves the points unchanged. Their product with the rotation between
// is a rotation again.
ScenePose reversed(const PoseScene& scene, const std::vector<bool>& use, const ScenePose& pose) {
  std::vector<Eigen::Vector3d> used;
  for (size_t i = 0; i < use.size(); ++i) {
    if (use[i]) used.push_back(scene.points[i]);
  }
  Eigen::MatrixXd rows(used.size(), 3);
  for (size_t i = 0; i < used.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = used[i];
  const Eigen::RowVector3d mean = rows.colwise().mean();
  rows.rowwise() -= mean;
  const Eigen::Vector3d normal = thin_svd(rows).v.col(2);
  const Eigen::Vector3d center = pose.center + pose.rotation * mean.transpose();
  const Eigen::Vector3d sight = center.normalized();
  const auto mirror = [](const Eigen::Vector3d& across) -> Eigen::Matrix3d {
    return Eigen::Matrix3d::Identity() - 2 * across * across.transpose();
  };
  const Eigen::Matrix3d rotation = mirror(sight) * pose.rotation * mirror(normal);
  return {rotation, center - rotation * mean.transpose()};
}

std::vector<ScenePose> starts(const PoseScene& scene, const std::vector<bool>& use,
                              const ScenePose& pose) {
  std::vector<ScenePose> out = {reversed(scene, use, pose)};
  std::vector<size_t> used;
  for (size_t i = 0; i < use.size(); ++i) {
    if (use[i]) used.push_back(i);
  }
  if (used.size() > 6) return out;
  for (size_t i = 0; i < used.size(); ++i) {
    for (size_t j = i + 1; j < used.size(); ++j) {
      for (size_t k = j + 1; k < used.size(); ++k) {
        const auto poses = poses_from_three(scene, {used[i], used[j], used[k]});
        out.insert(out.end(), poses.begin(), poses.end());
      }
    }
  }
  return out;
}

}  // namespace

std::optional<PoseFit> second_pose(const PoseScene& scene, const std::vector<bool>& use,
                                   const PoseFit& first, double noise_std_px) {
  std::optional<PoseFit> best;
  for (const ScenePose& start : starts(scene, use, first.pose)) {
    const PoseFit fit = refine_pose(scene, use, start);
    if (!std::isfinite(fit.sum_squares_px2)) continue;
    const Eigen::Matrix<double, 6, 1> away = pose_difference(first.pose, fit.pose);
    const double distance_squared =
        away.dot(first.information * away) / (noise_std_px * noise_std_px);
    if (distance_squared <= 9) continue;
    if (!best || fit.sum_squares_px2 < best->sum_squares_px2) best = fit;
  }
  return best;
}

}  // namespace scattermeter::calib
