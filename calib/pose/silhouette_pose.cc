#include "calib/pose/silhouette_pose.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "calib/pose/pose_prior.h"
#include "core/base/chi_square.h"
#include "core/base/cross_matrix.h"
#include "core/base/dense_solve.h"
#include "core/base/median.h"

namespace scattermeter::calib {

namespace {

// Of a fit of the pose to the silhouette's pieces; the prior is left to the caller.
EdgeFitOptions options_of(const Silhouette& silhouette) {
  EdgeFitOptions fit;
  fit.free = pose_parameters();
  fit.line_std_px = silhouette.line_std_px;
  fit.piece_std_px = silhouette.piece_std_px;
  return fit;
}

}  // namespace

std::optional<Silhouette> without_strays(const Silhouette& silhouette) {
  constexpr double kStray = 4.0;
  constexpr double kMostStrays = 0.2;
  std::vector<double> offsets;
  for (const EdgePoint& p : silhouette.points) offsets.push_back(p.offset_px);
  const double std = kStdPerMad * median_absolute_deviation(std::move(offsets), 0.0);
  Silhouette out = silhouette;
  const std::size_t strays = std::erase_if(out.points, [&](const EdgePoint& p) {
    return std::abs(p.offset_px) > kStray * std::hypot(std, p.std_px);
  });
  const double share = static_cast<double>(strays) / static_cast<double>(silhouette.points.size());
  if (strays == 0 || share > kMostStrays) return std::nullopt;
  out.pieces_left_out += strays;
  return out;
}

EdgeFit fit_alone(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                  double distance_mm) {
  EdgeFitOptions fit = options_of(silhouette);
  fit.prior = loose_pose_prior(edge_parameters(silhouette.points), distance_mm);
  return fit_edges(silhouette.points, intrinsics, silhouette.camera_from_world, fit);
}

EdgeFit fit_with_pose(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                      const PoseResult& prior) {
  const Eigen::Index size = edge_parameters(silhouette.points);
  EdgeFitOptions fit = options_of(silhouette);
  fit.prior = Eigen::MatrixXd::Zero(size, size);
  fit.prior.topLeftCorner<6, 6>() = SymmetricSolver(prior.covariance).inverse();
  return fit_edges(silhouette.points, intrinsics, prior.camera_from_world, fit);
}

PoseResult combine(const Silhouette& silhouette, const CameraIntrinsics& intrinsics,
                   const PoseResult& prior) {
  PoseResult out = prior;
  // The silhouette alone, then with the prior: the increase of the sum of squares measures the
  // difference of the two, a chi-square with six degrees of freedom.
  const EdgeFit alone =
      fit_alone(silhouette, intrinsics, prior.camera_from_world.translation_mm.norm());
  const EdgeFit both = fit_with_pose(silhouette, intrinsics, prior);
  if (!alone.converged || !both.converged) {
    out.status = PoseStatus::kIllConditioned;
    out.message = "the silhouette's least squares do not converge";
    return out;
  }
  if (chi_square_tail(std::max(0.0, both.chi2 - alone.chi2), 6) < 1e-6) {
    out.status = PoseStatus::kNoConsensus;
    out.message =
        "the object's silhouette and the pose contradict each other: camera, object or lens have "
        "changed since the points were measured, or the mesh is not the object";
    return out;
  }
  out.camera_from_world = both.camera_from_world;
  out.covariance = both.covariance.topLeftCorner<6, 6>();
  out.noise_std_px = silhouette.line_std_px;
  out.rms_px = 0;
  out.worst_px = 0;
  for (const double r : both.residual_px) {
    out.rms_px += r * r / static_cast<double>(both.residual_px.size());
    out.worst_px = std::max(out.worst_px, std::abs(r));
  }
  out.rms_px = std::sqrt(out.rms_px);
  // Centre -R^T t: its displacement is -R^T (dt - w x t) = -R^T (dt + [t]_x w).
  const Eigen::Matrix3d rt = out.camera_from_world.rotation.conjugate().toRotationMatrix();
  const Eigen::Vector3d t = out.camera_from_world.translation_mm;
  Eigen::Matrix<double, 3, 6> by_pose;
  by_pose << -rt * cross_matrix(t), -rt;
  out.center_std_mm =
      (by_pose * out.covariance * by_pose.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  return out;
}

}  // namespace scattermeter::calib
