// The nuisances of SceneNuisances that move what the samples see: pose, lens, the picture's shift
// and blur, and the object's position and size.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/core.h>

#include "core/base/covariance_root.h"
#include "core/base/cross_matrix.h"
#include "core/base/tangents.h"
#include "core/camera/lens.h"
#include "core/camera/lens_parameters.h"
#include "core/camera/pose_shift.h"
#include "core/material/fresnel.h"
#include "core/nuisances/nuisance_columns.h"
#include "core/nuisances/nuisances.h"
#include "core/view/row_blur.h"

namespace scattermeter {
namespace {

// Of log Ft(eta, cos_theta) by the cosine.
double log_slope(double eta, double cos_theta) {
  const double step = 1e-3 * cos_theta;
  return std::log(fresnel_transmittance(eta, std::min(1.0, cos_theta + step)) /
                  fresnel_transmittance(eta, cos_theta - step)) /
         (std::min(1.0, cos_theta + step) - (cos_theta - step));
}

// Right and down, in the world.
Eigen::Matrix<double, 3, 2> axes_of_picture(const Rigid3d& camera_from_world) {
  return camera_from_world.rotation.toRotationMatrix().transpose().leftCols<2>();
}

}  // namespace

Eigen::Matrix3Xd SceneNuisances::gradient_per_mm(const ObservedShot& shot,
                                                 const std::vector<Eigen::Index>& rows) const {
  const SeenObject& seen = *shot.seen;
  Eigen::Matrix3Xd out = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(rows.size()));
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene_.light(name);
    if (light->is_fitted()) continue;
    const ChannelSensitivity& own =
        sensitivities_.at({shot.seen.get(), name, light.channel_of(channel_)});
    const double power = light->power()[static_cast<Eigen::Index>(channel_)];
    for (Eigen::Index i = 0; i < out.cols(); ++i) {
      const Eigen::Index row = rows[static_cast<std::size_t>(i)];
      const auto along =
          tangents(seen.patches->normal(seen.map.patch_of_row[static_cast<std::size_t>(row)]));
      for (std::size_t t = 0; t < 2; ++t) {
        out.col(i) += power * own.sensitivity->per_tangent_mm[t](row, own.medium) * along[t];
      }
    }
  }
  return out;
}

SceneNuisances::SeenChange SceneNuisances::seen_change(
    const ObservedShot& shot, const std::vector<Eigen::Index>& rows) const {
  const SeenObject& seen = *shot.seen;
  const auto n = static_cast<Eigen::Index>(rows.size());
  SeenChange out{gradient_per_mm(shot, rows), Eigen::Matrix3Xd::Zero(3, n)};
  Eigen::VectorXd l = Eigen::VectorXd::Zero(n);
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene_.light(name);
    if (light->is_fitted()) continue;
    const ChannelSensitivity& own =
        sensitivities_.at({shot.seen.get(), name, light.channel_of(channel_)});
    l += light->power()[static_cast<Eigen::Index>(channel_)] * own.sensitivity->l(rows, own.medium);
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
    const int patch = seen.map.patch_of_row[row];
    const Eigen::Vector3d& site_mm = seen.sites[row].center_mm;
    const Eigen::Vector3d normal = seen.patches->normal_at(patch, site_mm);
    const Eigen::Vector3d to_camera = (seen.camera_center_mm - site_mm).normalized();
    // The observed l = pi L / Ft falls as Ft grows.
    const double per_cos = l[i] * log_slope(seen.object->stated->eta_int_over_ext,
                                            std::max(normal.dot(to_camera), 1e-3));
    const Eigen::Matrix3d turn_per_mm =
        seen.patches->surface_normals().change_per_mm(seen.patches->facet_idx(patch));
    out.per_mm.col(i) += per_cos * turn_per_mm.transpose() * to_camera;
    out.per_direction.col(i) = per_cos * normal;
  }
  return out;
}

// Change of each row's l by a small change of the pose.
Eigen::Matrix<double, Eigen::Dynamic, 6> SceneNuisances::change_by_pose(
    const ObservedShot& shot, const std::vector<Eigen::Index>& rows, const SeenChange& change) {
  const SeenObject& seen = *shot.seen;
  const Rigid3d& pose = shot.pose.camera_from_world;
  Eigen::Matrix<double, Eigen::Dynamic, 6> out(change.per_mm.cols(), 6);
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
    const Eigen::Vector3d& site_mm = seen.sites[row].center_mm;
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[row]);
    out.row(i) = change.per_mm.col(i).transpose() * surface_shift_by_pose(pose, site_mm, normal) +
                 change.per_direction.col(i).transpose() * direction_change_by_pose(pose, site_mm);
  }
  return out;
}

Eigen::VectorXd SceneNuisances::light_by_shift(const ObservedShot& shot,
                                               const std::vector<Eigen::Index>& rows) const {
  const PoseShift& shift = shot.seen->shift;
  if (shift.isZero(0.0)) return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  return -change_by_pose(shot, rows, seen_change(shot, rows)) * shift;
}

// The effect of pose and lens on the rows. The lens is common to all shots; a pose fitted with a
// wrong lens has absorbed part of its error (PoseResult::per_lens_parameter), so the two change
// together. The pose's own uncertainty is independent of that.
void SceneNuisances::add_view(const ObservedShot& shot, const SeenChange& change,
                              Columns& columns) const {
  const SeenObject& seen = *shot.seen;
  const Rigid3d& pose = shot.pose.camera_from_world;
  const LensRoot& lens_root = scene_.camera.lens_root;
  const auto n = static_cast<Eigen::Index>(columns.rows().size());
  const Eigen::Matrix<double, Eigen::Dynamic, 6> by_pose =
      change_by_pose(shot, columns.rows(), change);
  const Eigen::Matrix<double, Eigen::Dynamic, 6> by_pose_root =
      by_pose * covariance_root(shot.pose.covariance);
  Eigen::MatrixXd by_lens_root(n, lens_root.cols());
  Eigen::Matrix<double, Eigen::Dynamic, 2> by_shift(n, 2);
  const CameraIntrinsics& intrinsics = scene_.camera.intrinsics;
  const Eigen::Array2d ray_per_px(1.0 / intrinsics.fx_px, 1.0 / intrinsics.fy_px);
  const Lens lens(intrinsics);
  const LensParameters parameters = lens_parameters(intrinsics);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(columns.rows()[static_cast<std::size_t>(i)]);
    const Eigen::Vector3d& site_mm = seen.sites[row].center_mm;
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[row]);
    const Eigen::Matrix<double, 1, 2> by_ray =
        change.per_mm.col(i).transpose() * surface_shift_by_ray(pose, site_mm, normal) +
        change.per_direction.col(i).transpose() * direction_change_by_ray(pose, site_mm);
    by_shift.row(i) = by_ray.array() * ray_per_px.transpose();
    if (lens_root.cols() == 0) continue;
    by_lens_root.row(i) =
        (by_ray * ray_per_lens_parameter(lens, parameters, (pose * site_mm).hnormalized()) +
         by_pose.row(i) * shot.pose.per_lens_parameter) *
        lens_root;
  }
  // One pose for all shots, or one per shot.
  for (Eigen::Index k = 0; k < 6; ++k) {
    columns.add(shot.pose_name() + std::to_string(k), "pose", 1.0, by_pose_root.col(k));
  }
  for (Eigen::Index k = 0; k < 2 && !shot.has_own_pose && scene_.shot_shift_std_px > 0.0; ++k) {
    columns.add(fmt::format("shift{} {}", k, shot.stated->file), "camera shift",
                scene_.shot_shift_std_px, by_shift.col(k));
  }
  for (Eigen::Index k = 0; k < by_lens_root.cols(); ++k) {
    columns.add("lens" + std::to_string(k), "lens", 1.0, by_lens_root.col(k));
  }
}

// The effect of the object's position, orientation and size: what the samples see shifts along the
// surface as if the camera moved, and every LED moves the other way. A larger object looks like the
// mesh with camera and LEDs nearer to its centre, LEDs of less power, and coefficients that are
// larger by as much (apply_mesh_scale()). The standings of one piece have one size. Turns that
// leave a round body in its place change nothing: what its facets and the derivatives' own errors
// make of them must not count as evidence.
void SceneNuisances::add_place(const ObservedShot& shot, const SeenChange& seen_change,
                               Columns& columns) const {
  const SeenObject& seen = *shot.seen;
  const SceneObject& stated = *seen.object->stated;
  if (!(stated.position_std_mm > 0.0) && !(shot.size_relative_std() > 0.0)) return;
  const Rigid3d& pose = shot.pose.camera_from_world;
  const Eigen::Vector3d& center_mm = seen.object->box.center_mm();
  const auto n = static_cast<Eigen::Index>(columns.rows().size());
  Eigen::Matrix<double, 6, 7> pose_by_place;
  pose_by_place << pose_shift_by_place(pose, center_mm), pose_shift_by_size(pose, center_mm);
  Eigen::Matrix<double, Eigen::Dynamic, 7> change =
      change_by_pose(shot, columns.rows(), seen_change) * pose_by_place;
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene_.light(name);
    const LedLight* led = light.led();
    if (led == nullptr || !led->moves()) continue;
    const ChannelSensitivity& own = sensitivities_.at({shot.seen.get(), name, 0});
    const double power = light->power()[static_cast<Eigen::Index>(channel_)];
    Eigen::Matrix<double, Eigen::Dynamic, 3> by_position(n, 3);
    for (Eigen::Index k = 0; k < 3; ++k) {
      by_position.col(k) =
          columns.of(own.sensitivity->per_change[static_cast<std::size_t>(k)], own.medium);
    }
    by_position *= power;
    const Eigen::Vector3d from_center_mm = led->led.position_mm - center_mm;
    change.leftCols<3>() -= by_position;
    // The LED moves by -(w x (p - c)).
    change.middleCols<3>(3) += by_position * cross_matrix(from_center_mm);
    change.col(6) -=
        by_position * from_center_mm + 2.0 * power * columns.of(own.sensitivity->l, own.medium);
  }
  const double std_mm = stated.position_std_mm;
  change.middleCols<3>(3) *= seen.object->displacing_turns;
  for (Eigen::Index k = 0; k < 6 && std_mm > 0.0; ++k) {
    if (k >= 3 && seen.object->displacing_turns.col(k - 3).isZero(1e-6)) continue;
    columns.add(stated.name + ".position" + std::to_string(k), "mesh position",
                k < 3 ? std_mm : std_mm / seen.object->size_mm(), change.col(k));
  }
  if (shot.size_relative_std() > 0.0) {
    columns.add(stated.piece_name() + ".size", "mesh scale", shot.size_relative_std(),
                change.col(6));
  }
}

Eigen::VectorXd SceneNuisances::change_by_blur(const ObservedShot& shot,
                                               const std::vector<Eigen::Index>& rows,
                                               const Eigen::Matrix2d& covariance_mm2) const {
  const SeenObject& seen = *shot.seen;
  // Of chosen rows (core/view/chosen_rows.h), none are adjacent.
  if (seen.map.adjacent_rows.empty()) {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  }
  std::vector<Eigen::Index> all(seen.sites.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<Eigen::Vector3d> centers_mm, normals;
  for (std::size_t row = 0; row < seen.sites.size(); ++row) {
    centers_mm.push_back(seen.sites[row].center_mm);
    normals.push_back(seen.patches->normal(seen.map.patch_of_row[row]));
  }
  const BlurredRows of_view{centers_mm, normals, seen.map.adjacent_rows, seen.camera_center_mm,
                            axes_of_picture(shot.pose.camera_from_world)};
  return scattermeter::change_by_blur(of_view, gradient_per_mm(shot, all), covariance_mm2)(rows);
}

Eigen::VectorXd SceneNuisances::light_by_blur(const ObservedShot& shot,
                                              const std::vector<Eigen::Index>& rows) const {
  if (!shot.edge_blur || shot.edge_blur->mm2.isZero(0.0)) {
    return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  }
  return change_by_blur(shot, rows, shot.edge_blur->mm2);
}

// What outlines tell of the point spread is off by a share of it, as its shape is not known (motion
// is no Gaussian), and by what the fit to a sharp edge may yield. Where they tell nothing, it may
// be most of a pixel. Samples without frames are sharp.
void SceneNuisances::add_blur(const ObservedShot& shot, Columns& columns) const {
  constexpr double kShare = 1.0;
  constexpr double kSharp_px2 = 0.05;
  constexpr double kUnknown_px2 = 0.4;
  if (!shot.edge_blur) return;
  const double px_mm = shot.px_mm(scene_.camera.intrinsics.fx_px);
  const double least_px2 = shot.edge_blur->is_measured ? kSharp_px2 : kUnknown_px2;
  const Eigen::Matrix2d by_std_mm2 =
      kShare * shot.edge_blur->mm2 + least_px2 * px_mm * px_mm * Eigen::Matrix2d::Identity();
  columns.add("blur of " + shot.stated->material + " " + shot.seen->object->stated->name, "focus",
              1.0, change_by_blur(shot, columns.rows(), by_std_mm2));
}

}  // namespace scattermeter
