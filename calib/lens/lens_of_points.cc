#include "calib/lens/lens_of_points.h"

#include <algorithm>

#include <fmt/core.h>

#include "calib/pose/shot_pose.h"
#include "core/base/chi_square.h"
#include "core/base/covariance_root.h"
#include "core/base/cross_matrix.h"
#include "core/base/dense_solve.h"
#include "core/camera/lens.h"

namespace scattermeter::calib {
namespace {

// Of the inliers: residuals and their derivatives by the columns of the root, the pose following.
struct ByLens {
  Eigen::VectorXd residuals_px;
  Eigen::MatrixXd jacobian_px;
};

ByLens by_lens(const CameraIntrinsics& intrinsics, const LensRoot& root,
               const std::vector<PointPair>& points, const PoseResult& pose) {
  const Lens lens(intrinsics);
  const LensParameters parameters = lens_parameters(intrinsics);
  const auto n = static_cast<Eigen::Index>(points.size());
  ByLens out{Eigen::VectorXd::Zero(2 * n), Eigen::MatrixXd::Zero(2 * n, root.cols())};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!pose.inlier[k]) continue;
    const Eigen::Vector3d& world_mm = points[k].world_mm;
    Eigen::Matrix<double, 2, 3> by_point;
    const Eigen::Vector3d x = pose.camera_from_world * world_mm;
    const Eigen::Vector2d px = lens.project(x, &by_point);
    Eigen::Matrix<double, 2, 6> by_pose;
    by_pose.leftCols<3>() = -by_point * cross_matrix(pose.camera_from_world.rotation * world_mm);
    by_pose.rightCols<3>() = by_point;
    out.residuals_px.segment<2>(2 * i) = px - points[k].image_px;
    out.jacobian_px.middleRows<2>(2 * i) = (by_pose * pose.per_lens_parameter +
                                            shift_per_lens_parameter(parameters, x.hnormalized())) *
                                           root;
  }
  return out;
}

std::ptrdiff_t inliers(const PoseResult& pose) {
  return std::count(pose.inlier.begin(), pose.inlier.end(), true);
}

// That the inliers of the pose, and what else makes up a chi-square, depart so far by chance.
double p_value(const PoseResult& pose, double point_std_px, double rest = 0.0) {
  const auto n = static_cast<double>(inliers(pose));
  const double rms = pose.rms_px / point_std_px;
  return chi_square_tail(n * rms * rms + rest, 2.0 * n - 6.0);
}

}  // namespace

LensOfPoints lens_of_points(const CameraIntrinsics& stated, const LensRoot& root,
                            const std::vector<PointPair>& points, const PoseOptions& options) {
  constexpr int kMostSteps = 20;
  constexpr double kSettled = 1e-3;   // of the prior's deviations
  constexpr double kFarthest = 10.0;  // beyond, no one believes it
  const double variance_px2 = options.point_std_px * options.point_std_px;
  LensOfPoints out{stated, root, Eigen::VectorXd::Zero(root.cols()), {}};
  for (int step = 0;; ++step) {
    out.intrinsics = intrinsics_of(lens_parameters(stated) + root * out.deviations, stated.width_px,
                                   stated.height_px);
    if (!(out.deviations.norm() < kFarthest) || !intrinsics_problem(out.intrinsics).empty()) {
      return out;
    }
    out.pose = estimate_pose(out.intrinsics, points, options);
    if (out.pose.status != PoseStatus::kOk) return out;
    const ByLens now = by_lens(out.intrinsics, root, points, out.pose);
    Eigen::MatrixXd information = now.jacobian_px.transpose() * now.jacobian_px / variance_px2;
    information.diagonal().array() += 1.0;
    const SymmetricSolver solver(information);
    const Eigen::VectorXd change = -solver.solve(
        now.jacobian_px.transpose() * now.residuals_px / variance_px2 + out.deviations);
    if (change.norm() < kSettled || step == kMostSteps) {
      out.p_value = p_value(out.pose, options.point_std_px, out.deviations.squaredNorm());
      out.root = root * covariance_root(solver.inverse());
      return out;
    }
    out.deviations += change;
  }
}

std::string take_lens_of_points(const PoseSource& source, Scene& scene) {
  SceneCamera& camera = scene.camera;
  if (source.points.empty() || camera.lens_root.cols() == 0) return "";
  // The stated lens stays unless chance explains the points less often than this, ...
  constexpr double kByChance = 1e-3;
  // ... and if what it would have to be is less probable than this, by itself or with the points.
  constexpr double kPlausible = 1e-4;
  const PoseResult as_stated = estimate_pose(camera.intrinsics, source.points, source.options);
  const bool has_pose = as_stated.status == PoseStatus::kOk;
  const bool agree = has_pose && p_value(as_stated, source.options.point_std_px) > kByChance;
  if (agree && inliers(as_stated) == static_cast<std::ptrdiff_t>(source.points.size())) return "";
  const LensOfPoints found =
      lens_of_points(camera.intrinsics, camera.lens_root, source.points, source.options);
  const bool is_plausible =
      found.pose.status == PoseStatus::kOk && found.p_value > kPlausible &&
      chi_square_tail(found.deviations.squaredNorm(),
                      static_cast<double>(found.deviations.size())) > kPlausible;
  // Those that agree with each other speak for the stated lens unless another one explains more.
  const std::ptrdiff_t least = has_pose ? inliers(as_stated) + (agree ? 1 : 0) : 0;
  if (!is_plausible || inliers(found.pose) < least) return "";
  const double longer = found.intrinsics.fx_px / camera.intrinsics.fx_px - 1.0;
  camera.intrinsics = found.intrinsics;
  camera.lens_root = found.root;
  return fmt::format(
      "the lens is as the pose points show it, within what the rig states: focal length {:+.2f} %, "
      "centre [{:.1f}, {:.1f}] px",
      100.0 * longer, found.intrinsics.cx_px, found.intrinsics.cy_px);
}

std::string take_points_and_lens(Scene& scene, const capture::ShotDecoding& decoding,
                                 const std::string& shots_folder, PoseSource& source) {
  take_points_from_board_shot(scene, decoding, shots_folder, source);
  return take_lens_of_points(source, scene);
}

}  // namespace scattermeter::calib
