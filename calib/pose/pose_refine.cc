#include "calib/pose/pose_refine.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/base/cross_matrix.h"
#include "core/base/dense_solve.h"
#include "core/base/rotation_vector.h"

namespace scattermeter::calib {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

double sum_squares(const PoseScene& scene, const std::vector<bool>& use, const ScenePose& pose) {
  double sum = 0;
  for (size_t i = 0; i < use.size(); ++i) {
    if (!use[i]) continue;
    const Eigen::Vector3d x = pose.rotation * scene.points[i] + pose.center;
    sum += (scene.lens.project(x) - scene.image_px[i]).squaredNorm();
  }
  return std::isfinite(sum) ? sum : kInfinity;
}

// Image of the point of a pair, and its Jacobian J. With y = R p: d(R p)/dw = -[y]_x, d(center)/dd
// = I.
Eigen::Vector2d seen_at(const PoseScene& scene, size_t i, const ScenePose& pose,
                        Eigen::Matrix<double, 2, 6>* jacobian) {
  Eigen::Matrix<double, 2, 3> by_point;
  const Eigen::Vector3d y = pose.rotation * scene.points[i];
  const Eigen::Vector2d px = scene.lens.project(y + pose.center, &by_point);
  jacobian->leftCols<3>() = -by_point * cross_matrix(y);
  jacobian->rightCols<3>() = by_point;
  return px;
}

// J^T J and J^T r.
void normal_equations(const PoseScene& scene, const std::vector<bool>& use, const ScenePose& pose,
                      Matrix6d* information, Vector6d* gradient) {
  information->setZero();
  gradient->setZero();
  Eigen::Matrix<double, 2, 6> jacobian;
  for (size_t i = 0; i < use.size(); ++i) {
    if (!use[i]) continue;
    const Eigen::Vector2d r = seen_at(scene, i, pose, &jacobian) - scene.image_px[i];
    *information += jacobian.transpose() * jacobian;
    *gradient += jacobian.transpose() * r;
  }
}

}  // namespace

PoseScene make_scene(const CameraIntrinsics& intrinsics, const std::vector<PointPair>& pairs) {
  PoseScene scene{Lens(intrinsics), {}, {}, {}, Eigen::Vector3d::Zero(), 1};
  const auto n = static_cast<double>(pairs.size());
  // In two passes, so that a far origin leaves no rounding in the centroid.
  const Eigen::Vector3d first = pairs.front().world_mm;
  Eigen::Vector3d mean_offset = Eigen::Vector3d::Zero();
  for (const PointPair& pair : pairs) mean_offset += (pair.world_mm - first) / n;
  scene.centroid_mm = first + mean_offset;
  double sum = 0;
  for (const PointPair& pair : pairs) sum += (pair.world_mm - scene.centroid_mm).squaredNorm();
  scene.scale_mm = std::sqrt(sum / n);
  for (const PointPair& pair : pairs) {
    scene.points.emplace_back((pair.world_mm - scene.centroid_mm) / scene.scale_mm);
    scene.image_px.push_back(pair.image_px);
    scene.rays.push_back(scene.lens.unproject(pair.image_px));
  }
  return scene;
}

Rigid3d camera_from_world(const PoseScene& scene, const ScenePose& pose) {
  const Eigen::Quaterniond rotation = Eigen::Quaterniond(pose.rotation).normalized();
  return {rotation, pose.center * scene.scale_mm - rotation * scene.centroid_mm};
}

std::vector<Eigen::Vector2d> residuals(const PoseScene& scene, const ScenePose& pose) {
  std::vector<Eigen::Vector2d> out;
  out.reserve(scene.points.size());
  for (size_t i = 0; i < scene.points.size(); ++i) {
    const Eigen::Vector3d x = pose.rotation * scene.points[i] + pose.center;
    out.emplace_back(scene.lens.project(x) - scene.image_px[i]);
  }
  return out;
}

PoseFit refine_pose(const PoseScene& scene, const std::vector<bool>& use, const ScenePose& start,
                    int max_iterations) {
  PoseFit fit;
  fit.pose = start;
  fit.sum_squares_px2 = sum_squares(scene, use, start);
  if (!std::isfinite(fit.sum_squares_px2)) return fit;
  double damping = 1e-4;
  Vector6d gradient;
  normal_equations(scene, use, fit.pose, &fit.information, &gradient);
  for (int i = 0; i < max_iterations; ++i) {
    Matrix6d damped = fit.information;
    damped.diagonal() *= 1 + damping;
    const Vector6d step = -SymmetricSolver(damped).solve(gradient);
    if (!step.allFinite()) break;
    // g^T H^-1 g is the remaining decrease in px^2; over the variance of one coordinate, sum / (2
    // n), it is the squared distance to the optimum in standard deviations. The floor ends
    // noise-free problems at 1e-10 px.
    const double drop = -gradient.dot(step);
    const auto used = static_cast<double>(std::count(use.begin(), use.end(), true));
    if (drop <= 1e-12 * fit.sum_squares_px2 / (2 * used) + 1e-20) {
      fit.converged = true;
      break;
    }
    const ScenePose next{rotation_by(step.head<3>()) * fit.pose.rotation,
                         fit.pose.center + step.tail<3>()};
    const double next_sum = sum_squares(scene, use, next);
    if (next_sum < fit.sum_squares_px2) {
      fit.pose = next;
      fit.sum_squares_px2 = next_sum;
      normal_equations(scene, use, fit.pose, &fit.information, &gradient);
      damping = std::max(damping * 0.1, 1e-12);
    } else {
      damping *= 10;
      // No step of any size reduces the cost: this is the optimum in double precision.
      if (damping > 1e12) {
        fit.converged = true;
        break;
      }
    }
  }
  fit.pose.rotation = Eigen::Quaterniond(fit.pose.rotation).normalized().toRotationMatrix();
  return fit;
}

PosePerLens gradient_per_lens_parameter(const PoseScene& scene, const std::vector<bool>& use,
                                        const ScenePose& pose, const LensParameters& lens) {
  PosePerLens out = PosePerLens::Zero();
  Eigen::Matrix<double, 2, 6> jacobian;
  for (size_t i = 0; i < use.size(); ++i) {
    if (!use[i]) continue;
    seen_at(scene, i, pose, &jacobian);
    const Eigen::Vector3d x = pose.rotation * scene.points[i] + pose.center;
    out += jacobian.transpose() * shift_per_lens_parameter(lens, x.hnormalized());
  }
  return out;
}

Eigen::Matrix<double, 6, 1> pose_difference(const ScenePose& from, const ScenePose& to) {
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.rotation * from.rotation.transpose()));
  Vector6d difference;
  difference << turn.angle() * turn.axis(), to.center - from.center;
  return difference;
}

}  // namespace scattermeter::calib
