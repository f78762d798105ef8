#include "calib/pose/pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "calib/pose/pose_ambiguity.h"
#include "calib/pose/pose_layout.h"
#include "calib/pose/pose_refine.h"
#include "calib/pose/pose_search.h"
#include "core/base/dense_solve.h"
#include "core/base/symmetric_eigen.h"

namespace scattermeter::calib {
namespace {

constexpr double kNoPose = std::numeric_limits<double>::quiet_NaN();
using Matrix6d = Eigen::Matrix<double, 6, 6>;

void check_pairs(const std::vector<PointPair>& pairs) {
  for (size_t i = 0; i < pairs.size(); ++i) {
    const PointPair& pair = pairs[i];
    if (pair.world_mm.allFinite() && pair.image_px.allFinite()) continue;
    std::ostringstream out;
    out << "estimate_pose: pair " << i << " is not finite: world_mm [" << pair.world_mm.transpose()
        << "], image_px [" << pair.image_px.transpose() << "]";
    throw std::invalid_argument(out.str());
  }
}

PoseResult fault_result(size_t pairs, const PoseFault& fault) {
  PoseResult result;
  result.status = fault.status;
  result.message = fault.message;
  result.camera_from_world.rotation.coeffs().setConstant(kNoPose);
  result.camera_from_world.translation_mm.setConstant(kNoPose);
  result.covariance.setConstant(kNoPose);
  result.per_lens_parameter.setConstant(kNoPose);
  result.noise_std_px = result.rms_px = result.worst_px = kNoPose;
  result.residuals_px.assign(pairs, Eigen::Vector2d(kNoPose, kNoPose));
  result.inlier.assign(pairs, false);
  result.center_std_mm.setConstant(kNoPose);
  return result;
}

int count(const std::vector<bool>& flags) {
  return static_cast<int>(std::count(flags.begin(), flags.end(), true));
}

bool is_consensus(int inliers, size_t pairs) {
  return inliers >= 4 && 2 * static_cast<size_t>(inliers) > pairs;
}

// Whether more pairs fit the mirror image of the world than the `inliers` that fit the world: a
// pose with x_in_camera = -(R x + c) has the same image as one that sees the points -x in front.
bool is_mirrored(PoseScene scene, int inliers, const PoseOptions& options) {
  for (Eigen::Vector3d& point : scene.points) point = -point;
  const int others = find_consensus(scene, options.inlier_px, options.confidence).inliers;
  return is_consensus(others, scene.points.size()) && others > inliers;
}

PoseFault mirror_fault() {
  return {PoseStatus::kBehindCamera,
          "the points fit only a pose that has them behind the camera, so the world coordinates "
          "are those of a mirror image; check the signs and the order of the world's axes, and "
          "that image y counts downwards"};
}

// The reason why there is no consensus.
PoseFault consensus_fault(const PoseScene& scene, int inliers, const PoseOptions& options) {
  const size_t n = scene.points.size();
  if (is_mirrored(scene, inliers, options)) return mirror_fault();
  inliers = std::max(inliers, 3);  // some pose fits any three
  std::ostringstream out;
  if (2 * static_cast<size_t>(inliers) > n) {
    out << "of the " << n << " point pairs only " << inliers << " agree on one pose within "
        << options.inlier_px
        << " px, but four are needed; check their order and coordinates, or add "
        << "points";
    return {PoseStatus::kTooFewPoints, out.str()};
  }
  out << "no pose explains more than half of the " << n << " point pairs within "
      << options.inlier_px << " px (the best explains " << inliers
      << "); check the order of the points, their coordinates and the intrinsics";
  return {PoseStatus::kNoConsensus, out.str()};
}

// Alternates least squares and classification until the set of inliers no longer changes. Returns
// the fit; `inlier` is the set used for it.
PoseFit settle(const PoseScene& scene, double inlier_px, PoseFit fit, std::vector<bool>* inlier) {
  constexpr int kMaxRounds = 20;  // two sets can alternate for ever; either will do
  for (int round = 0; round < kMaxRounds; ++round) {
    fit = refine_pose(scene, *inlier, fit.pose);
    const std::vector<Eigen::Vector2d> r = residuals(scene, fit.pose);
    std::vector<bool> next(r.size());
    for (size_t i = 0; i < r.size(); ++i) next[i] = r[i].norm() <= inlier_px;
    if (next == *inlier || !is_consensus(count(next), r.size())) break;
    *inlier = next;
  }
  return refine_pose(scene, *inlier, fit.pose);
}

double noise_std(const PoseFit& fit, int inliers, double point_std_px) {
  const int freedom = 2 * inliers - 6;
  return std::max(point_std_px, std::sqrt(fit.sum_squares_px2 / freedom));
}

// Covariance about the centroid, of (w, d) in rad and units of scale_mm. NaN where singular.
Matrix6d centroid_covariance(const PoseFit& fit, double noise_std_px) {
  const SymmetricEigen eigen = symmetric_eigen(fit.information);
  if (!(eigen.values[0] > 1e-14 * eigen.values[5])) return Matrix6d::Constant(kNoPose);
  return noise_std_px * noise_std_px * eigen.vectors * eigen.values.cwiseInverse().asDiagonal() *
         eigen.vectors.transpose();
}

// From a motion (w, d) about the centroid, in rad and units of scale_mm, to (w, displacement in mm
// of the object's point at `lever_mm` from the centroid, camera axes): the motion takes y to
// y + w x y + d, so the displacement is d - [lever]_x w.
Matrix6d motion_at(const PoseScene& scene, const Eigen::Vector3d& lever_mm) {
  const Eigen::Vector3d& l = lever_mm;
  Matrix6d move = Matrix6d::Identity();
  move.block<3, 3>(3, 0) << 0, l.z(), -l.y(), -l.z(), 0, l.x(), l.y(), -l.x(), 0;
  move.block<3, 3>(3, 3) *= scene.scale_mm;
  return move;
}

// Covariance of such a motion.
Matrix6d covariance_at(const PoseScene& scene, const Matrix6d& about_centroid,
                       const Eigen::Vector3d& lever_mm) {
  const Matrix6d move = motion_at(scene, lever_mm);
  const Matrix6d covariance = move * about_centroid * move.transpose();
  return 0.5 * (covariance + covariance.transpose());
}

double largest_std(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite()) return std::numeric_limits<double>::infinity();
  return std::sqrt(symmetric_eigen(covariance).values[2]);
}

std::optional<PoseFault> condition_fault(const PoseScene& scene, const PoseFit& fit,
                                         const Matrix6d& camera_covariance) {
  const double turn_rad = largest_std(camera_covariance.topLeftCorner<3, 3>());
  const double shift = largest_std(camera_covariance.bottomRightCorner<3, 3>()) /
                       (fit.pose.center.norm() * scene.scale_mm);
  if (fit.converged && turn_rad <= 0.05 && shift <= 0.05) return std::nullopt;
  std::ostringstream out;
  out << "the points fix the pose too loosely (rotation to " << turn_rad
      << " rad, camera position to " << shift
      << " of its distance); use points that fill more of the frame and more depth";
  return PoseFault{PoseStatus::kIllConditioned, out.str()};
}

// The evidence for the first pose over the second: with Gaussian noise the likelihoods stand as
// exp(difference of the sums of squares / (2 sigma^2)) to 1; 2 ln(10^4) = 18.4.
std::optional<PoseFault> ambiguity_fault(const PoseFit& first, const PoseFit& second,
                                         double noise_std_px, const PoseOptions& options) {
  const double evidence =
      (second.sum_squares_px2 - first.sum_squares_px2) / (noise_std_px * noise_std_px);
  const double ratio = std::sqrt(second.sum_squares_px2 / first.sum_squares_px2);
  if (evidence >= 18.4 && ratio >= options.ambiguity_ratio) return std::nullopt;
  const Eigen::Vector3d turn = pose_difference(first.pose, second.pose).head<3>();
  std::ostringstream out;
  out.precision(3);
  out << "two poses, " << turn.norm() << " rad apart, explain the points about equally well "
      << "(sums of squares " << first.sum_squares_px2 << " and " << second.sum_squares_px2
      << " px^2); add points out of their plane, come closer, or look at it more obliquely";
  return PoseFault{PoseStatus::kPlanarAmbiguity, out.str()};
}

}  // namespace

void PoseOptions::Check() const {
  const auto fail = [](const char* field, const char* rule, double value) {
    std::ostringstream out;
    out << "PoseOptions." << field << " must be " << rule << ", got " << value;
    throw std::invalid_argument(out.str());
  };
  const auto positive = [](double v) { return std::isfinite(v) && v > 0; };
  if (!positive(inlier_px)) fail("inlier_px", "positive and finite", inlier_px);
  if (!(confidence > 0 && confidence < 1)) fail("confidence", "in (0, 1)", confidence);
  if (!positive(point_std_px)) fail("point_std_px", "positive and finite", point_std_px);
  if (!(std::isfinite(ambiguity_ratio) && ambiguity_ratio >= 1)) {
    fail("ambiguity_ratio", "finite and at least 1", ambiguity_ratio);
  }
}

PoseResult estimate_pose(const CameraIntrinsics& intrinsics, const std::vector<PointPair>& pairs,
                         const PoseOptions& options) {
  options.Check();
  check_pairs(pairs);
  if (const std::string problem = intrinsics_problem(intrinsics); !problem.empty()) {
    throw std::invalid_argument("estimate_pose: intrinsics: " + problem);
  }
  const std::vector<bool> all(pairs.size(), true);
  if (const auto fault = layout_fault(pairs, all, options.point_std_px)) {
    return fault_result(pairs.size(), *fault);
  }
  const PoseScene scene = make_scene(intrinsics, pairs);
  PoseConsensus consensus = find_consensus(scene, options.inlier_px, options.confidence);
  if (!is_consensus(consensus.inliers, pairs.size())) {
    return fault_result(pairs.size(), consensus_fault(scene, consensus.inliers, options));
  }
  std::vector<bool>& inlier = consensus.inlier;
  PoseFit fit = settle(scene, options.inlier_px, consensus.fit, &inlier);
  const int inliers = count(inlier);
  const double px_per_mm =
      std::sqrt(intrinsics.fx_px * intrinsics.fy_px) / (fit.pose.center.z() * scene.scale_mm);
  auto fault = layout_fault(pairs, inlier, options.point_std_px);
  // Those in one plane fit either way; the others then were the outliers.
  if (!fault && inliers < static_cast<int>(pairs.size()) && is_mirrored(scene, inliers, options)) {
    fault = mirror_fault();
  }
  if (!fault) fault = seen_as_line_fault(pairs, inlier, px_per_mm, options.point_std_px);
  if (fault) return fault_result(pairs.size(), *fault);

  PoseResult result;
  double noise_std_px = noise_std(fit, inliers, options.point_std_px);
  auto second = second_pose(scene, inlier, fit, noise_std_px);
  if (second && second->sum_squares_px2 < fit.sum_squares_px2) {
    std::swap(fit, *second);
    noise_std_px = noise_std(fit, inliers, options.point_std_px);
  }
  const Matrix6d about_centroid = centroid_covariance(fit, noise_std_px);
  const Eigen::Vector3d origin_mm = -(fit.pose.rotation * scene.centroid_mm);
  result.covariance = covariance_at(scene, about_centroid, origin_mm);
  result.per_lens_parameter =
      -motion_at(scene, origin_mm) * SymmetricSolver(fit.information)
                                         .solve_columns(gradient_per_lens_parameter(
                                             scene, inlier, fit.pose, lens_parameters(intrinsics)));
  // The camera as a point of the object: its displacement if it moved with the object. In the world
  // the camera moves by the opposite.
  const Eigen::Vector3d camera_mm = -scene.scale_mm * fit.pose.center;
  const Matrix6d camera_covariance = covariance_at(scene, about_centroid, camera_mm);
  fault = condition_fault(scene, fit, camera_covariance);
  if (!fault && second) fault = ambiguity_fault(fit, *second, noise_std_px, options);

  result.status = fault ? fault->status : PoseStatus::kOk;
  if (fault) result.message = fault->message;
  result.camera_from_world = camera_from_world(scene, fit.pose);
  result.noise_std_px = noise_std_px;
  result.residuals_px = residuals(scene, fit.pose);
  result.inlier = inlier;
  result.rms_px = std::sqrt(fit.sum_squares_px2 / inliers);
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (inlier[i]) result.worst_px = std::max(result.worst_px, result.residuals_px[i].norm());
  }
  result.center_std_mm = (fit.pose.rotation.transpose() *
                          camera_covariance.bottomRightCorner<3, 3>() * fit.pose.rotation)
                             .diagonal()
                             .cwiseSqrt();
  return result;
}

}  // namespace scattermeter::calib
