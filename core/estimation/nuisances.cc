#include "core/estimation/nuisances.h"

#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "core/base/covariance_root.h"
#include "core/base/cross_matrix.h"
#include "core/camera/lens.h"
#include "core/camera/lens_parameters.h"
#include "core/camera/pose_shift.h"
#include "core/estimation/even_light.h"
#include "core/scene/surroundings.h"

namespace scattermeter {

// Columns by the names of their nuisances; lights that share a nuisance add up.
class SceneNuisances::Columns {
 public:
  explicit Columns(const std::vector<Eigen::Index>& rows) : rows_(rows) {}
  const std::vector<Eigen::Index>& rows() const { return rows_; }
  template <class Change>
  void add(const std::string& name, const std::string& group, double std, const Change& change) {
    for (NuisanceColumn& column : list_) {
      if (column.nuisance.name != name) continue;
      column.change += change;
      return;
    }
    list_.push_back({{group, std, std > 0.0, name}, change});
  }
  // Of a quantity on all rows of the view.
  Eigen::VectorXd of(const Eigen::MatrixXd& on_view, Eigen::Index medium) const {
    return on_view(rows_, medium);
  }
  std::vector<NuisanceColumn> take() { return std::move(list_); }

 private:
  const std::vector<Eigen::Index>& rows_;
  std::vector<NuisanceColumn> list_;
};

SceneNuisances::SceneNuisances(const Scene& scene, std::size_t channel,
                               std::map<LightKey, ChannelSensitivity> sensitivities)
    : scene_(scene), channel_(channel), sensitivities_(std::move(sensitivities)) {}

void SceneNuisances::add_light(const SceneLight& light, const ChannelSensitivity& own,
                               Columns& columns) const {
  const LightSensitivity& s = *own.sensitivity;
  const double power = light->power()[static_cast<Eigen::Index>(channel_)];
  const auto n = static_cast<Eigen::Index>(columns.rows().size());
  Eigen::MatrixXd by(n, static_cast<Eigen::Index>(s.per_change.size()));
  for (std::size_t k = 0; k < s.per_change.size(); ++k) {
    by.col(static_cast<Eigen::Index>(k)) = columns.of(s.per_change[k], own.medium);
  }
  const Eigen::VectorXd l = columns.of(s.l, own.medium);
  for (const LightNuisance& v : light->nuisances(light.name, channel_)) {
    Eigen::VectorXd change = (power * v.of_power + v.of_unit_power) * l;
    if (v.of_change.size() > 0) change += power * (by * v.of_change);
    columns.add(v.name, v.group, v.std, change);
  }
}

// dl / d albedo, of all LEDs; empty if the plane changes nothing.
Eigen::VectorXd SceneNuisances::change_by_albedo(const ObservedShot& shot,
                                                 const std::vector<Eigen::Index>& rows) const {
  Eigen::VectorXd change;
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene_.light(name);
    const auto own = sensitivities_.find({shot.seen.get(), name, light.channel_of(channel_)});
    if (own == sensitivities_.end()) continue;
    const Eigen::MatrixXd& per_albedo = own->second.sensitivity->per_albedo;
    if (per_albedo.size() == 0) continue;
    if (change.size() == 0) change.setZero(static_cast<Eigen::Index>(rows.size()));
    change +=
        light->power()[static_cast<Eigen::Index>(channel_)] * per_albedo(rows, own->second.medium);
  }
  return change;
}

Eigen::VectorXd SceneNuisances::light_by_plane(const ObservedShot& shot,
                                               const std::vector<Eigen::Index>& rows) const {
  const Eigen::VectorXd change = change_by_albedo(shot, rows);
  if (change.size() == 0) return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  return plane_below(scene_, *shot.seen->object).in(channel_).albedo * change;
}

// Change of each row's l where what its samples see shifts along the surface.
Eigen::Matrix3Xd SceneNuisances::change_per_mm(const ObservedShot& shot,
                                               const std::vector<Eigen::Index>& rows) const {
  Eigen::Matrix3Xd per_mm = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(rows.size()));
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene_.light(name);
    if (light->is_fitted()) continue;
    const ChannelSensitivity& own =
        sensitivities_.at({shot.seen.get(), name, light.channel_of(channel_)});
    const double power = light->power()[static_cast<Eigen::Index>(channel_)];
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto along = tangents(shot.seen->patches->normal(
          shot.seen->map.patch_of_row[static_cast<std::size_t>(rows[i])]));
      for (std::size_t t = 0; t < 2; ++t) {
        per_mm.col(static_cast<Eigen::Index>(i)) +=
            power * own.sensitivity->per_tangent_mm[t](rows[i], own.medium) * along[t];
      }
    }
  }
  return per_mm;
}

// Change of each row's l by a small change of the pose, with per_mm of change_per_mm().
Eigen::Matrix<double, Eigen::Dynamic, 6> SceneNuisances::change_by_pose(
    const ObservedShot& shot, const std::vector<Eigen::Index>& rows,
    const Eigen::Matrix3Xd& per_mm) {
  const SeenObject& seen = *shot.seen;
  Eigen::Matrix<double, Eigen::Dynamic, 6> out(per_mm.cols(), 6);
  for (Eigen::Index i = 0; i < out.rows(); ++i) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
    out.row(i) = per_mm.col(i).transpose() *
                 surface_shift_by_pose(shot.pose.camera_from_world, seen.sites[row].center_mm,
                                       seen.patches->normal(seen.map.patch_of_row[row]));
  }
  return out;
}

Eigen::VectorXd SceneNuisances::light_by_shift(const ObservedShot& shot,
                                               const std::vector<Eigen::Index>& rows) const {
  const PoseShift& shift = shot.seen->shift;
  if (shift.isZero(0.0)) return Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  return -change_by_pose(shot, rows, change_per_mm(shot, rows)) * shift;
}

// The uncertainties of the radiance calibration: each shot's black, the glare, the shutter.
void SceneNuisances::add_radiance(const ObservedShot& shot, const ChannelObservation& observed,
                                  const Eigen::VectorXd& predicted, Columns& columns) const {
  const std::vector<Eigen::Index>& rows = columns.rows();
  const auto pick = [&](const std::vector<double>& of_row) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(of_row.data(),
                                             static_cast<Eigen::Index>(of_row.size()))(rows);
  };
  const Eigen::VectorXd l_per_count = pick(observed.l_per_count);
  for (std::size_t k = 0; k < shot.exposures.size(); ++k) {
    const ShotExposure& e = shot.exposures[k];
    // Share of the rows' l that comes from this exposure.
    const Eigen::VectorXd part = observed.exposures.empty()
                                     ? Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows.size()))
                                     : pick(observed.exposures[k].of_row);
    if (e.black_std_counts > 0.0) {
      columns.add("black " + e.file, "black level", e.black_std_counts,
                  (shot.exposure_s / e.true_s) * part.cwiseProduct(l_per_count));
    }
    if (e.pedestal_std_counts[channel_] > 0.0) {
      columns.add("pedestal " + e.file, "pedestal", e.pedestal_std_counts[channel_],
                  (shot.exposure_s / e.true_s) * part.cwiseProduct(l_per_count));
    }
    if (e.relative_std > 0.0) {
      columns.add(fmt::format("exposure {:.4g}", e.stated_s), "exposure time", e.relative_std,
                  part.cwiseProduct(predicted));
    }
  }
  const double glare_std = scene_.camera.glare_std[channel_];
  if (glare_std > 0.0) {
    columns.add("glare", "veiling glare", glare_std,
                shot.frame_mean_counts[channel_] * l_per_count);
  }
}

// The effect of pose and lens on the rows. The lens is common to all shots; a pose fitted with a
// wrong lens has absorbed part of its error (PoseResult::per_lens_parameter), so the two change
// together. The pose's own uncertainty is independent of that. per_mm: of change_per_mm().
void SceneNuisances::add_view(const ObservedShot& shot, const Eigen::Matrix3Xd& per_mm,
                              Columns& columns) const {
  const SeenObject& seen = *shot.seen;
  const Rigid3d& pose = shot.pose.camera_from_world;
  const LensRoot& lens_root = scene_.camera.lens_root;
  const Eigen::Matrix<double, 6, 6> pose_root = covariance_root(shot.pose.covariance);
  const auto n = static_cast<Eigen::Index>(columns.rows().size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> by_pose_root(n, 6);
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
    const Eigen::Matrix<double, 3, 6> by_pose = surface_shift_by_pose(pose, site_mm, normal);
    const Eigen::Matrix<double, 3, 2> by_ray = surface_shift_by_ray(pose, site_mm, normal);
    by_pose_root.row(i) = per_mm.col(i).transpose() * by_pose * pose_root;
    by_shift.row(i) = (per_mm.col(i).transpose() * by_ray).array() * ray_per_px.transpose();
    if (lens_root.cols() == 0) continue;
    const Eigen::Matrix<double, 3, kLensParameters> by_lens =
        by_ray * ray_per_lens_parameter(lens, parameters, (pose * site_mm).hnormalized()) +
        by_pose * shot.pose.per_lens_parameter;
    by_lens_root.row(i) = per_mm.col(i).transpose() * by_lens * lens_root;
  }
  // One pose for all shots, or one per shot.
  const std::string name = shot.has_own_pose ? "pose " + shot.stated->file : "pose";
  for (Eigen::Index k = 0; k < 6; ++k) {
    columns.add(name + std::to_string(k), "pose", 1.0, by_pose_root.col(k));
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
// larger by as much (core/estimation/mesh_scale.h).
void SceneNuisances::add_place(const ObservedShot& shot, const Eigen::Matrix3Xd& per_mm,
                               Columns& columns) const {
  const SeenObject& seen = *shot.seen;
  const SceneObject& stated = *seen.object->stated;
  if (!(stated.position_std_mm > 0.0) && !(stated.scale_relative_std > 0.0)) return;
  const Rigid3d& pose = shot.pose.camera_from_world;
  const Eigen::Vector3d& center_mm = seen.object->box.center_mm();
  const auto n = static_cast<Eigen::Index>(columns.rows().size());
  Eigen::Matrix<double, 6, 7> pose_by_place;
  pose_by_place << pose_shift_by_place(pose, center_mm), pose_shift_by_size(pose, center_mm);
  Eigen::Matrix<double, Eigen::Dynamic, 7> change =
      change_by_pose(shot, columns.rows(), per_mm) * pose_by_place;
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
  for (Eigen::Index k = 0; k < 6 && std_mm > 0.0; ++k) {
    columns.add(stated.name + ".position" + std::to_string(k), "mesh position",
                k < 3 ? std_mm : std_mm / seen.object->size_mm(), change.col(k));
  }
  if (stated.scale_relative_std > 0.0) {
    columns.add(stated.name + ".size", "mesh scale", stated.scale_relative_std, change.col(6));
  }
}

void SceneNuisances::add_even_light(const ObservedShot& shot, Columns& columns) const {
  const auto own = sensitivities_.find(even_light_key(shot));
  if (own == sensitivities_.end()) return;
  const double std = scene_.even_light_share_std *
                     facing_irradiance_W_per_mm2(scene_, shot, channel_) / std::numbers::pi;
  if (!(std > 0.0)) return;
  columns.add("even light " + shot.stated->file, "even light", std,
              columns.of(own->second.sensitivity->l, own->second.medium));
}

std::vector<NuisanceColumn> SceneNuisances::columns(const ObservedShot& shot,
                                                    const ChannelObservation& observed,
                                                    const std::vector<Eigen::Index>& rows) const {
  Columns columns(rows);
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::VectorXd predicted = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd per_eta = Eigen::VectorXd::Zero(n);
  bool has_view = false;
  const double eta_std = shot.seen->object->stated->eta_std;
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene_.light(name);
    const ChannelSensitivity& own =
        sensitivities_.at({shot.seen.get(), name, light.channel_of(channel_)});
    const LightSensitivity& s = *own.sensitivity;
    const double intensity = light->power()[static_cast<Eigen::Index>(channel_)];
    predicted += intensity * columns.of(s.l, own.medium);
    add_light(light, own, columns);
    if (light->is_fitted()) continue;
    has_view = true;
    per_eta += intensity * columns.of(s.per_eta, own.medium);
    if (s.per_edge_mm.size() > 0) {
      columns.add(shot.seen->object->stated->name + ".edges", "edges",
                  shot.seen->object->stated->edge_std_mm,
                  intensity * columns.of(s.per_edge_mm, own.medium));
    }
  }
  if (has_view) {
    const Eigen::Matrix3Xd per_mm = change_per_mm(shot, rows);
    add_view(shot, per_mm, columns);
    add_place(shot, per_mm, columns);
    add_even_light(shot, columns);
    columns.add("eta", "eta", eta_std, per_eta);
  }
  const Eigen::VectorXd by_albedo = change_by_albedo(shot, rows);
  if (by_albedo.size() > 0) {
    const ScenePlane plane = plane_below(scene_, *shot.seen->object);
    const double std = plane.albedo_std[static_cast<Eigen::Index>(channel_)];
    if (std > 0.0) columns.add("plane albedo", "surroundings", std, by_albedo);
  }
  add_radiance(shot, observed, predicted, columns);
  return columns.take();
}

}  // namespace scattermeter
