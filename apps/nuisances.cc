#include "apps/nuisances.h"

#include <utility>

#include <Eigen/Cholesky>
#include <fmt/core.h>

#include "apps/radiance_file.h"
#include "calib/lens_reaction.h"
#include "core/covariance_root.h"
#include "core/pose_shift.h"

namespace scattermeter::apps {

// Columns by the names of their nuisances; lights that share a nuisance add up.
class RigNuisances::Columns {
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
    list_.push_back({{group, std, true, name}, change});
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

namespace {

template <class Parameters>
Parameters seen_by(std::size_t channel) {
  return {0, 1, 2, 3, 4, 5, calib::kLedLogIntensity + static_cast<Eigen::Index>(channel)};
}

}  // namespace

RigNuisances::RigNuisances(const Rig& rig, std::size_t channel,
                           std::map<LightKey, TaskSensitivity> sensitivities)
    : rig_(rig),
      channel_(channel),
      sensitivities_(std::move(sensitivities)),
      lens_root_(lens_root(rig.camera)) {
  const auto seen = seen_by<std::array<Eigen::Index, kSeen>>(channel);
  for (const RigLight& light : rig.lights) {
    if (!light.calibrated) continue;
    // Of what the LED does not share with others.
    const calib::LedUncertainty& u = *light.calibrated;
    const calib::LedMatrix own = u.covariance - u.common * u.common.transpose();
    led_root_[light.name] = covariance_root(own(seen, seen));
  }
}

// Columns are combinations of the parameters, so that what the calibration could not tell apart
// stays together (distance and power, say).
void RigNuisances::add_calibrated(const RigLight& light, double intensity,
                                  const TaskSensitivity& task, Columns& columns) const {
  const LightSensitivity& s = *task.sensitivity;
  const auto seen = seen_by<std::array<Eigen::Index, kSeen>>(channel_);
  Eigen::MatrixXd by(static_cast<Eigen::Index>(columns.rows().size()), kSeen);
  for (std::size_t i = 0; i < 3; ++i) {
    by.col(static_cast<Eigen::Index>(i)) = columns.of(s.per_mm[i], task.medium);
  }
  for (std::size_t t = 0; t < 2; ++t) {
    by.col(calib::kLedAxis + static_cast<Eigen::Index>(t)) = columns.of(s.per_rad[t], task.medium);
  }
  by.col(calib::kLedExponent) = columns.of(s.per_exponent, task.medium);
  by.col(calib::kLedLogIntensity) = columns.of(s.l, task.medium);
  const Eigen::MatrixXd change = intensity * (by * led_root_.at(light.name));
  for (Eigen::Index k = 0; k < kSeen; ++k) {
    columns.add(light.name + ".calibration" + std::to_string(k), "LED calibration", 1.0,
                change.col(k));
  }
  const calib::LedVector& common = light.calibrated->common;
  if (!common.isZero(0.0)) {
    columns.add("white plane", "LED calibration", 1.0,
                intensity * (by * Eigen::VectorXd(common(seen))));
  }
}

void RigNuisances::add_light(const RigLight& light, double intensity, const TaskSensitivity& task,
                             Columns& columns) const {
  const LightSensitivity& s = *task.sensitivity;
  for (std::size_t i = 0; light.position_std_mm > 0.0 && i < 3; ++i) {
    columns.add(light.name + ".position" + std::to_string(i), "LED position", light.position_std_mm,
                intensity * columns.of(s.per_mm[i], task.medium));
  }
  if (light.exponent_std > 0.0) {
    columns.add(light.name + ".exponent", "LED exponent", light.exponent_std,
                intensity * columns.of(s.per_exponent, task.medium));
  }
  if (light.power_relative_std > 0.0) {
    columns.add(light.name + ".power", light.environment ? "environment power" : "LED power",
                light.power_relative_std, intensity * columns.of(s.l, task.medium));
  }
}

// What the radiance calibration leaves open: each shot's black, the glare, the shutter.
void RigNuisances::add_radiance(const OpenedShot& shot, const ChannelObservation& observed,
                                const Eigen::VectorXd& predicted, Columns& columns) const {
  if (!rig_.camera.radiance) return;
  const std::vector<Eigen::Index>& rows = columns.rows();
  const auto pick = [&](const std::vector<double>& of_row) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(of_row.data(),
                                             static_cast<Eigen::Index>(of_row.size()))(rows);
  };
  const Eigen::VectorXd l_per_count = pick(observed.l_per_count);
  for (std::size_t k = 0; k < shot.exposures.size(); ++k) {
    const ShotExposure& e = shot.exposures[k];
    // What part of the rows' l comes from this exposure.
    const Eigen::VectorXd part = observed.exposures.empty()
                                     ? Eigen::VectorXd::Ones(static_cast<Eigen::Index>(rows.size()))
                                     : pick(observed.exposures[k].of_row);
    if (e.black_std_counts > 0.0) {
      columns.add("black " + e.file, "black level", e.black_std_counts,
                  (shot.exposure_s / e.true_s) * part.cwiseProduct(l_per_count));
    }
    if (e.relative_std > 0.0) {
      columns.add(fmt::format("exposure {:.4g}", e.stated_s), "exposure time", e.relative_std,
                  part.cwiseProduct(predicted));
    }
  }
  const double glare_std = rig_.camera.radiance->correction.glare_std[channel_];
  if (glare_std > 0.0) {
    columns.add("glare", "veiling glare", glare_std,
                shot.frame_mean_counts[channel_] * l_per_count);
  }
}

// What pose and lens do to the rows. The lens is one for all shots; where it was wrong, the pose
// was fitted through the wrong lens, too, and has taken up part of it
// (PoseResult::per_lens_parameter): the two go together. What the pose's own marks leave open is
// independent of that. per_mm: change of each row's l where what its samples see shifts along the
// surface.
void RigNuisances::add_view(const OpenedShot& shot, const Eigen::Matrix3Xd& per_mm,
                            Columns& columns) const {
  const SeenObject& seen = *shot.seen;
  const Rigid3d& pose = shot.pose.camera_from_world;
  const Eigen::Matrix<double, 6, 6> pose_root = covariance_root(shot.pose.covariance);
  const auto n = static_cast<Eigen::Index>(columns.rows().size());
  Eigen::Matrix<double, Eigen::Dynamic, 6> by_pose_root(n, 6);
  Eigen::MatrixXd by_lens_root(n, lens_root_.cols());
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(columns.rows()[static_cast<std::size_t>(i)]);
    const Eigen::Vector3d& site_mm = seen.sites[row].center_mm;
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[row]);
    const Eigen::Matrix<double, 3, 6> by_pose = surface_shift_by_pose(pose, site_mm, normal);
    by_pose_root.row(i) = per_mm.col(i).transpose() * by_pose * pose_root;
    if (lens_root_.cols() == 0) continue;
    const Eigen::Matrix<double, 3, calib::kLensParameters> by_lens =
        surface_shift_by_ray(pose, site_mm, normal) *
            calib::ray_per_lens_parameter(rig_.camera.intrinsics, (pose * site_mm).hnormalized()) +
        by_pose * shot.pose.per_lens_parameter;
    by_lens_root.row(i) = per_mm.col(i).transpose() * by_lens * lens_root_;
  }
  // One pose for all shots, or one a shot.
  const std::string name =
      rig_.pose.charuco || rig_.pose.per_shot ? "pose " + shot.rig->file : "pose";
  for (Eigen::Index k = 0; k < 6; ++k) {
    columns.add(name + std::to_string(k), "pose", 1.0, by_pose_root.col(k));
  }
  for (Eigen::Index k = 0; k < by_lens_root.cols(); ++k) {
    columns.add("lens" + std::to_string(k), "lens", 1.0, by_lens_root.col(k));
  }
}

std::vector<NuisanceColumn> RigNuisances::columns(const OpenedShot& shot,
                                                  const ChannelObservation& observed,
                                                  const std::vector<Eigen::Index>& rows) const {
  Columns columns(rows);
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::VectorXd predicted = Eigen::VectorXd::Zero(n);
  Eigen::Matrix3Xd per_mm = Eigen::Matrix3Xd::Zero(3, n);
  Eigen::VectorXd per_eta = Eigen::VectorXd::Zero(n);
  bool has_view = false;
  const double eta_std = shot.seen->object->rig->eta_std;
  for (const std::string& name : shot.rig->lights) {
    const RigLight& light = rig_.light(name);
    const TaskSensitivity& task =
        sensitivities_.at({shot.seen.get(), name, light.colours_differ() ? channel_ : 0});
    const LightSensitivity& s = *task.sensitivity;
    const double intensity = light.power()[static_cast<Eigen::Index>(channel_)];
    const double ambient_std = light.ambient_std_W_per_mm2_sr[static_cast<Eigen::Index>(channel_)];
    const Eigen::VectorXd l = columns.of(s.l, task.medium);
    if (ambient_std > 0.0) columns.add(light.name + ".ambient", "ambient", ambient_std, l);
    predicted += intensity * l;
    if (light.is_ambient) continue;
    if (light.calibrated) {
      add_calibrated(light, intensity, task, columns);
    } else {
      add_light(light, intensity, task, columns);
    }
    has_view = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Index row = rows[static_cast<std::size_t>(i)];
      const auto along = tangents(
          shot.seen->patches->normal(shot.seen->map.patch_of_row[static_cast<std::size_t>(row)]));
      for (std::size_t t = 0; t < 2; ++t) {
        per_mm.col(i) += intensity * s.per_tangent_mm[t](row, task.medium) * along[t];
      }
    }
    if (eta_std > 0.0) per_eta += intensity * columns.of(s.per_eta, task.medium);
  }
  if (has_view) {
    add_view(shot, per_mm, columns);
    if (eta_std > 0.0) columns.add("eta", "eta", eta_std, per_eta);
  }
  add_radiance(shot, observed, predicted, columns);
  return columns.take();
}

}  // namespace scattermeter::apps
