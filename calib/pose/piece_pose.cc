#include "calib/pose/piece_pose.h"

#include <cstddef>
#include <stdexcept>
#include <utility>

#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "calib/pose/silhouette_pose.h"
#include "core/base/chi_square.h"
#include "core/base/cross_matrix.h"
#include "core/base/dense_solve.h"
#include "core/base/rotation_vector.h"

namespace scattermeter::calib {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double kContradicts = 1e-6;

Eigen::Vector3d rotation_vector(const Eigen::Quaterniond& q) {
  const Eigen::AngleAxisd turn(q.w() < 0.0 ? Eigen::Quaterniond(-q.coeffs()) : q);
  return turn.angle() * turn.axis();
}

// From one motion of the piece to another: (displacement of its centre, turn about it).
Vector6d between(const Rigid3d& from, const Rigid3d& to, const Eigen::Vector3d& center_mm) {
  Vector6d out;
  out << to * center_mm - from * center_mm,
      rotation_vector(to.rotation * from.rotation.conjugate());
  return out;
}

// From the stated position, or, where that is too far off, from a few others.
Silhouette silhouette_from_near(const PieceView& view, const CameraIntrinsics& intrinsics,
                                const Eigen::Vector3d& center_mm, const PiecePoseOptions& options) {
  constexpr double kTurn_rad = 0.07;
  const int turns = options.may_be_turned ? 6 : 0;
  const Rigid3d& camera = view.camera.camera_from_world;
  Silhouette best = find_silhouette(view.shots, intrinsics, camera, options.silhouette);
  for (int k = 0; k < turns && best.status != SilhouetteStatus::kOk; ++k) {
    Vector6d turned = Vector6d::Zero();
    turned[3 + k / 2] = k % 2 == 0 ? kTurn_rad : -kTurn_rad;
    Silhouette other = find_silhouette(
        view.shots, intrinsics, camera * followed_by({}, turned, center_mm), options.silhouette);
    if (other.status == SilhouetteStatus::kOk) best = std::move(other);
  }
  return best;
}

// What a view shows of the piece.
struct Seen {
  Rigid3d moved;
  Matrix6d covariance;  // as PiecePose::covariance
};

// A change (w, dt) of a pose as by PoseResult::covariance moves a point y of the camera frame,
// before the translation, by w x y + dt. Here: of the displacement and turn of what stands at
// center_mm in the world, seen in world axes.
Matrix6d in_world(const Rigid3d& camera_from_world, const Eigen::Vector3d& relative_center) {
  const Eigen::Matrix3d world_from_camera =
      camera_from_world.rotation.conjugate().toRotationMatrix();
  Matrix6d out = Matrix6d::Zero();
  out.topLeftCorner<3, 3>() = -world_from_camera * cross_matrix(relative_center);
  out.topRightCorner<3, 3>() = world_from_camera;
  out.bottomLeftCorner<3, 3>() = world_from_camera;
  return out;
}

Seen seen_in(const PieceView& view, const Silhouette& found, const CameraIntrinsics& intrinsics,
             const Eigen::Vector3d& center_mm) {
  const Rigid3d& camera = view.camera.camera_from_world;
  const EdgeFit fit = fit_alone(found, intrinsics, found.camera_from_world.translation_mm.norm());
  Seen out{inverse(camera) * fit.camera_from_world, {}};
  // The outline moves the piece, an error of the camera's pose takes it along.
  const Matrix6d by_outline = in_world(camera, fit.camera_from_world.rotation * center_mm);
  const Matrix6d by_camera = in_world(camera, camera.rotation * (out.moved * center_mm));
  out.covariance = by_outline * fit.covariance.topLeftCorner<6, 6>() * by_outline.transpose() +
                   by_camera * view.camera.covariance * by_camera.transpose();
  return out;
}

// By the information of each; false if they contradict each other.
bool combine_views(const std::vector<Seen>& views, const Eigen::Vector3d& center_mm, Seen& out) {
  const Rigid3d& first = views.front().moved;
  Matrix6d information = Matrix6d::Zero();
  Vector6d weighted = Vector6d::Zero();
  double squares = 0.0;
  for (const Seen& view : views) {
    const Matrix6d own = SymmetricSolver(view.covariance).inverse();
    const Vector6d off = between(first, view.moved, center_mm);
    information += own;
    weighted += own * off;
    squares += off.dot(own * off);
  }
  out.covariance = SymmetricSolver(information).inverse();
  const Vector6d mean = out.covariance * weighted;
  out.moved = followed_by(first, mean, center_mm);
  const double dof = 6.0 * static_cast<double>(views.size() - 1);
  return dof == 0.0 || chi_square_tail(squares - mean.dot(weighted), dof) > kContradicts;
}

// Back onto the plane; the reason if the outline contradicts it.
std::string settle_on_plane(const Eigen::Vector3d& center_mm, const PiecePoseOptions& options,
                            Seen& piece) {
  const Eigen::Vector3d up = piece.moved.rotation * Eigen::Vector3d::UnitZ();
  // Height and tilt.
  const Eigen::Vector3d off((piece.moved * center_mm).z() - center_mm.z(), -up.y(), up.x());
  Eigen::Matrix<double, 3, 6> form = Eigen::Matrix<double, 3, 6>::Zero();
  form(0, 2) = form(1, 3) = form(2, 4) = 1.0;
  const double tilt_std_rad = options.plane_std_mm / options.size_mm;
  Eigen::Matrix3d expected = form * piece.covariance * form.transpose();
  expected.diagonal() +=
      Eigen::Vector3d(options.plane_std_mm, tilt_std_rad, tilt_std_rad).cwiseAbs2();
  const Eigen::Matrix3d inverse = SymmetricSolver(expected).inverse();
  if (chi_square_tail(off.dot(inverse * off), 3.0) < kContradicts) {
    return fmt::format(
        "by its outline, the piece is {:.2g} mm too {} and tilted by {:.2g} "
        "degrees, but it stands on the plane (on_plane: true): its mesh, the pose "
        "of the camera or the height of the plane is not as stated",
        std::abs(off[0]), off[0] > 0.0 ? "high" : "low", 57.29578 * off.tail<2>().norm());
  }
  const Eigen::Matrix<double, 6, 3> gain = piece.covariance * form.transpose() * inverse;
  piece.moved = followed_by(piece.moved, -gain * off, center_mm);
  piece.covariance -= gain * form * piece.covariance;
  return "";
}

}  // namespace

Rigid3d followed_by(const Rigid3d& motion, const Eigen::Matrix<double, 6, 1>& step,
                    const Eigen::Vector3d& center_mm) {
  const Eigen::Quaterniond q = rotation_by(step.tail<3>());
  const Eigen::Vector3d now_mm = motion * center_mm;
  return Rigid3d{q, now_mm + step.head<3>() - q * now_mm} * motion;
}

PiecePose find_piece(const std::vector<PieceView>& views, const CameraIntrinsics& intrinsics,
                     const Eigen::Vector3d& center_mm, const PiecePoseOptions& options) {
  if (views.empty()) throw std::invalid_argument("find_piece: no views");
  std::vector<Silhouette> found(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    found[i] = silhouette_from_near(views[i], intrinsics, center_mm, options);
  });
  std::vector<Seen> seen;
  PiecePose out;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (found[i].status == SilhouetteStatus::kOk) {
      seen.push_back(seen_in(views[i], found[i], intrinsics, center_mm));
    }
  }
  if (seen.empty()) {
    out.problem = found.back().message;
    return out;
  }
  Seen piece;
  if (!combine_views(seen, center_mm, piece)) {
    out.problem =
        "the shots show the piece at positions that contradict each other: it was moved between "
        "them";
    return out;
  }
  const Eigen::Vector3d from_camera_mm =
      piece.moved * center_mm - inverse(views.front().camera.camera_from_world).translation_mm;
  piece.covariance.topLeftCorner<3, 3>() += options.scale_relative_std *
                                            options.scale_relative_std * from_camera_mm *
                                            from_camera_mm.transpose();
  if (options.is_on_plane) out.problem = settle_on_plane(center_mm, options, piece);
  out.moved = piece.moved;
  out.off = between({}, piece.moved, center_mm);
  out.covariance = piece.covariance;
  return out;
}

}  // namespace scattermeter::calib
