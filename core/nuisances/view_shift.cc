#include "core/nuisances/view_shift.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/covariance_root.h"
#include "core/base/cross_matrix.h"
#include "core/base/dense_solve.h"
#include "core/camera/lens.h"
#include "core/camera/lens_parameters.h"

namespace scattermeter {
namespace {

// d(X / Z, Y / Z) of a world point by a shift of the pose.
Eigen::Matrix<double, 2, 6> ray_by_shift(const Rigid3d& pose, const Eigen::Vector3d& point_mm) {
  const Eigen::Vector3d p = pose * point_mm;
  Eigen::Matrix<double, 2, 3> by_point;
  by_point << 1.0 / p.z(), 0.0, -p.x() / (p.z() * p.z()), 0.0, 1.0 / p.z(),
      -p.y() / (p.z() * p.z());
  Eigen::Matrix<double, 2, 6> out;
  out.leftCols<3>() = -by_point * cross_matrix(pose.rotation * point_mm);
  out.rightCols<3>() = by_point;
  return out;
}

// The values of the nuisances "NAME0", "NAME1", ...
Eigen::VectorXd values_of(const std::string& name, Eigen::Index n,
                          const std::vector<PriorPull>& pulls) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  for (const PriorPull& p : pulls) {
    for (Eigen::Index k = 0; k < n; ++k) {
      if (p.name == name + std::to_string(k)) out[k] = believable(p);
    }
  }
  return out;
}

// The shift of the pose that moves the picture of the sites as a change of the lens does.
PoseShift shift_like_lens(const ObservedShot& shot, const CameraIntrinsics& intrinsics,
                          const LensParameters& change) {
  const Rigid3d& pose = shot.pose.camera_from_world;
  const Lens lens(intrinsics);
  const LensParameters parameters = lens_parameters(intrinsics);
  const auto n = static_cast<Eigen::Index>(shot.seen->sites.size());
  Eigen::MatrixXd by_shift(2 * n, 6);
  Eigen::VectorXd by_lens(2 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d& site_mm = shot.seen->sites[static_cast<std::size_t>(i)].center_mm;
    by_shift.middleRows<2>(2 * i) = ray_by_shift(pose, site_mm);
    // A ray that leaves the camera in another direction is a world that moves the other way.
    by_lens.segment<2>(2 * i) =
        -ray_per_lens_parameter(lens, parameters, (pose * site_mm).hnormalized()) * change;
  }
  const Eigen::VectorXd unit = by_shift.colwise().norm().cwiseInverse();
  const PivotedSolver solver(by_shift * unit.asDiagonal());
  return unit.asDiagonal() * solver.solve(by_lens);
}

}  // namespace

double believable(const PriorPull& p) {
  constexpr double kBelievable = 3.0;
  return p.offset * std::min(1.0, kBelievable / std::max(std::abs(p.pull), kBelievable));
}

double motion_in_patches(const ObservedShot& shot, const PoseShift& by) {
  const Rigid3d& pose = shot.pose.camera_from_world;
  double squares_mm2 = 0.0;
  for (const ExitSite& site : shot.seen->sites) {
    const double depth_mm = (pose * site.center_mm).z();
    squares_mm2 += (depth_mm * ray_by_shift(pose, site.center_mm) * by).squaredNorm();
  }
  return std::sqrt(squares_mm2 / static_cast<double>(shot.seen->sites.size())) /
         shot.seen->patches->patch_size_mm();
}

PoseShift most_probable_shift(const Scene& scene, const ObservedShot& shot,
                              const std::vector<PriorPull>& pulls) {
  const ObjectScene& object = *shot.seen->object;
  PoseShift out = covariance_root(shot.pose.covariance) * values_of(shot.pose_name(), 6, pulls);
  out += pose_shift_by_place(shot.pose.camera_from_world, object.box.center_mm()) *
         values_of(object.stated->name + ".position", 6, pulls);
  for (const PriorPull& p : pulls) {
    if (p.name != object.stated->name + ".size") continue;
    out += believable(p) * pose_shift_by_size(shot.pose.camera_from_world, object.box.center_mm());
  }
  const LensRoot& root = scene.camera.lens_root;
  if (root.cols() == 0) return out;
  const LensParameters lens = root * values_of("lens", root.cols(), pulls);
  if (lens.isZero(0.0)) return out;
  return out + shot.pose.per_lens_parameter * lens +
         shift_like_lens(shot, scene.camera.intrinsics, lens);
}

bool is_determined_elsewhere(const std::vector<PriorPull>& joint_pulls) {
  constexpr double kDetermined = 2.5;
  return std::any_of(joint_pulls.begin(), joint_pulls.end(), [](const PriorPull& p) {
    const bool moves = p.group == "pose" || p.group == "lens" || p.group == "mesh position" ||
                       p.group == "mesh scale";
    return moves && std::abs(p.offset) > kDetermined * p.std;
  });
}

SeenElsewhere seen_elsewhere(const Scene& scene, std::span<const ObservedShot> shots,
                             const std::vector<PriorPull>& pulls, double motion_before) {
  constexpr double kHalf = 0.5;
  SeenElsewhere out;
  if (pulls.empty()) return out;
  std::map<std::string, PoseShift> now;
  for (const ObservedShot& shot : shots) {
    if (!now.try_emplace(shot.view_name(), shot.seen->shift).second) continue;
    const PoseShift there = most_probable_shift(scene, shot, pulls);
    out.shifts.emplace(shot.view_name(), there);
    out.motion = std::max(out.motion, motion_in_patches(shot, there - shot.seen->shift));
  }
  if (out.motion < motion_before) return out;
  for (auto& [view, there] : out.shifts) {
    const PoseShift& here = now.at(view);
    there = here + kHalf * (there - here);
  }
  return out;
}

}  // namespace scattermeter
