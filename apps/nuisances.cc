#include "apps/nuisances.h"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <fmt/core.h>

#include "apps/radiance_file.h"
#include "apps/rig_lens.h"
#include "calib/lens_reaction.h"
#include "core/covariance_root.h"
#include "core/dipole.h"
#include "core/fresnel.h"
#include "core/incident_light.h"
#include "core/pose_shift.h"

namespace scattermeter::apps {
namespace {

constexpr double kExponentStep = 0.02;
constexpr double kEtaStep = 0.01;
constexpr double kTurnRad = 0.01;

// R on the knots, one column a medium, times its scale.
Eigen::MatrixXd curves(const std::vector<LitMedium>& media, const DistanceKnots& knots,
                       double eta) {
  Eigen::MatrixXd r(knots.size(), static_cast<Eigen::Index>(media.size()));
  for (std::size_t m = 0; m < media.size(); ++m) {
    Medium medium = media[m].medium;
    medium.eta_int_over_ext = eta;
    const Dipole dipole(medium);
    for (Eigen::Index i = 0; i < r.rows(); ++i) {
      r(i, static_cast<Eigen::Index>(m)) =
          media[m].scale *
          dipole.reflectance_per_mm2(knots.knots_mm()[static_cast<std::size_t>(i)]);
    }
  }
  return r;
}

}  // namespace

std::array<Eigen::Vector3d, 2> tangents(const Eigen::Vector3d& normal) {
  const Eigen::Vector3d first = normal.unitOrthogonal();
  return {first, normal.cross(first)};
}

ChangedWeights changed_weights(const SeenObject& seen, const RigLight& rig_light,
                               std::size_t channel, ObjectLibrary& library,
                               const DistanceKnots& knots) {
  const Led& led = rig_light.led;
  const ObjectScene& object = *seen.object;
  const double eta = object.rig->eta_int_over_ext;
  const PatchMesh coarse(object.mesh(), 2.0 * seen.patches->patch_size_mm());
  PairSumOptions pairs;
  pairs.floor_mm = 4.0 * knots.resolution_mm();
  pairs.far_ratio = 3.0;
  pairs.near_ratio = 0.7;
  const auto weights = [&](const std::vector<ExitSite>& sites, const Led& light, double eta_here) {
    const SourceCloud sources(
        rig_light.environment
            ? library.environment_light(object.rig->name, rig_light.name, channel, coarse, eta_here)
            : illuminate(coarse, seen.shadows != nullptr ? *seen.shadows : *object.rays, light,
                         eta_here),
        object.box.center_mm());
    return smooth_weights(sites, sources, knots, pairs);
  };
  ChangedWeights out;
  std::vector<ExitSite> centers;
  for (const ExitSite& site : seen.sites) centers.push_back(exit_point(site.center_mm));
  if (rig_light.is_ambient) {
    // What else is uncertain matters little to a small even light.
    out.nominal = smooth_weights(
        centers,
        SourceCloud(library.light(object.rig->name, rig_light.name, 0), object.box.center_mm()),
        knots, pairs);
    return out;
  }
  out.nominal = weights(centers, led, eta);
  // A hundredth of the distance: shadow edges then move by several of the parts that patches are
  // cut into, and the next order is still a hundredth of the first.
  out.move_mm = 0.01 * (led.position_mm - object.box.center_mm()).norm();
  const bool is_calibrated = rig_light.calibrated.has_value();
  for (int i = 0; i < 3 && (is_calibrated || rig_light.position_std_mm > 0.0); ++i) {
    Led moved = led;
    moved.position_mm[i] += out.move_mm;
    out.moved[static_cast<std::size_t>(i)] = weights(centers, moved, eta);
  }
  if (is_calibrated || rig_light.exponent_std > 0.0) {
    Led other = led;
    other.exponent += kExponentStep;
    out.other_exponent = weights(centers, other, eta);
  }
  out.turn_rad = kTurnRad;
  for (std::size_t t = 0; t < 2 && is_calibrated; ++t) {
    Led other = led;
    other.axis = (led.axis + kTurnRad * rig_light.calibrated->tangents[t]).normalized();
    out.turned[t] = weights(centers, other, eta);
  }
  if (object.rig->eta_std > 0.0) out.other_eta = weights(centers, led, eta + kEtaStep);
  out.shift_mm = 0.1 * seen.patches->patch_size_mm();
  std::array<std::vector<ExitSite>, 2> shifted = {centers, centers};
  for (std::size_t j = 0; j < centers.size(); ++j) {
    const auto along = tangents(seen.patches->normal(seen.map.patch_of_row[j]));
    for (std::size_t t = 0; t < 2; ++t) {
      shifted[t][j] = moved(centers[j], out.shift_mm * along[t]);
    }
  }
  for (std::size_t t = 0; t < 2; ++t) out.shifted[t] = weights(shifted[t], led, eta);
  return out;
}

LightSensitivity sensitivity(const SeenObject& seen, const WeightMatrix& nominal,
                             const ChangedWeights& weights, const std::vector<LitMedium>& media,
                             const DistanceKnots& knots) {
  const double eta = seen.object->rig->eta_int_over_ext;
  const Eigen::MatrixXd r = curves(media, knots, eta);
  const Eigen::MatrixXd l = weights.nominal * r;
  LightSensitivity out;
  out.l = nominal * r;
  const auto relative = [&](const Eigen::MatrixXd& changed, double by) -> Eigen::MatrixXd {
    const Eigen::ArrayXXd per_l = (changed - l).array() / (by * l.array());
    return (l.array() > 0.0).select(per_l * out.l.array(), 0.0);
  };
  const auto change = [&](const WeightMatrix& changed, double by) -> Eigen::MatrixXd {
    if (changed.size() == 0) return {};
    return relative(changed * r, by);
  };
  for (std::size_t i = 0; i < 3; ++i) out.per_mm[i] = change(weights.moved[i], weights.move_mm);
  out.per_exponent = change(weights.other_exponent, kExponentStep);
  for (std::size_t t = 0; t < 2; ++t) out.per_rad[t] = change(weights.turned[t], weights.turn_rad);
  for (std::size_t t = 0; t < 2; ++t) {
    out.per_tangent_mm[t] = change(weights.shifted[t], weights.shift_mm);
  }
  if (weights.other_eta.size() == 0) return out;
  out.per_eta = relative(weights.other_eta * curves(media, knots, eta + kEtaStep), kEtaStep);
  for (std::size_t j = 0; j < seen.sites.size(); ++j) {
    const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[j]);
    // The observed l = pi L / Ft(eta) falls as Ft grows.
    const Eigen::Vector3d to_camera =
        (seen.camera_center_mm - seen.sites[j].center_mm).normalized();
    const double cos_theta = normal.dot(to_camera);
    const double growth =
        fresnel_transmittance(eta, cos_theta) / fresnel_transmittance(eta + kEtaStep, cos_theta) -
        1.0;
    const auto row = static_cast<Eigen::Index>(j);
    out.per_eta.row(row) -= out.l.row(row) * (growth / kEtaStep);
  }
  return out;
}

namespace {

// Places of the columns, made on first use so that shots of one LED or pose share theirs.
class Columns {
 public:
  // The column of a nuisance, by a name that only this nuisance has.
  Eigen::Index at(const std::string& name, const std::string& group, double std) {
    const auto [it, is_new] = place_.try_emplace(name, static_cast<Eigen::Index>(list_.size()));
    if (is_new) list_.push_back({group, std, true, name});
    return it->second;
  }
  const std::vector<Nuisance>& list() const { return list_; }

 private:
  std::map<std::string, Eigen::Index> place_;
  std::vector<Nuisance> list_;
};

// One entry of a row: column and dl/dv.
using Entries = std::vector<std::pair<Eigen::Index, double>>;

struct RowContext {
  const Rig& rig;
  const OpenedShot& shot;
  std::size_t row;
  Eigen::Matrix<double, 6, 6> pose_root;  // pose covariance = root root^T
  const std::map<std::string, Eigen::Matrix<double, 7, 7>>& led_root;  // of calibrated LEDs
  const LensRoot& lens_root;
};

// The rows of an LED's covariance that one channel sees.
constexpr Eigen::Index kSeen = 7;
using SeenVector = Eigen::Matrix<double, kSeen, 1>;
using SeenMatrix = Eigen::Matrix<double, kSeen, kSeen>;

std::array<Eigen::Index, kSeen> seen_by(std::size_t channel) {
  return {0, 1, 2, 3, 4, 5, calib::kLedLogIntensity + static_cast<Eigen::Index>(channel)};
}

// Of what a calibrated LED does not share with others.
SeenMatrix own_root(const calib::LedUncertainty& u, std::size_t channel) {
  const auto seen = seen_by(channel);
  const calib::LedMatrix own = u.covariance - u.common * u.common.transpose();
  return covariance_root(own(seen, seen));
}

// Columns are combinations of the parameters, so that what the calibration could not tell apart
// stays together (distance and power, say).
void add_calibrated(const RowContext& c, const RigLight& light, std::size_t channel,
                    double intensity, const TaskSensitivity& task, Columns& columns,
                    Entries& entries) {
  const auto row = static_cast<Eigen::Index>(c.row);
  const LightSensitivity& s = *task.sensitivity;
  SeenVector by;
  for (std::size_t i = 0; i < 3; ++i) {
    by[static_cast<Eigen::Index>(i)] = s.per_mm[i](row, task.medium);
  }
  for (std::size_t t = 0; t < 2; ++t) {
    by[calib::kLedAxis + static_cast<Eigen::Index>(t)] = s.per_rad[t](row, task.medium);
  }
  by[calib::kLedExponent] = s.per_exponent(row, task.medium);
  by[calib::kLedLogIntensity] = s.l(row, task.medium);
  const SeenVector change = intensity * (c.led_root.at(light.name).transpose() * by);
  const auto add = [&](const std::string& name, double value) {
    entries.emplace_back(columns.at(name, "LED calibration", 1.0), value);
  };
  for (Eigen::Index k = 0; k < kSeen; ++k) {
    add(light.name + ".calibration" + std::to_string(k), change[k]);
  }
  const calib::LedVector& common = light.calibrated->common;
  if (!common.isZero(0.0)) {
    add("white plane", intensity * SeenVector(common(seen_by(channel))).dot(by));
  }
}

void add_light(const RowContext& c, const RigLight& light, double intensity,
               const TaskSensitivity& task, Columns& columns, Entries& entries) {
  const auto row = static_cast<Eigen::Index>(c.row);
  const LightSensitivity& s = *task.sensitivity;
  for (std::size_t i = 0; light.position_std_mm > 0.0 && i < 3; ++i) {
    entries.emplace_back(columns.at(light.name + ".position" + std::to_string(i), "LED position",
                                    light.position_std_mm),
                         intensity * s.per_mm[i](row, task.medium));
  }
  if (light.exponent_std > 0.0) {
    entries.emplace_back(columns.at(light.name + ".exponent", "LED exponent", light.exponent_std),
                         intensity * s.per_exponent(row, task.medium));
  }
  if (light.power_relative_std > 0.0) {
    entries.emplace_back(
        columns.at(light.name + ".power", light.environment ? "environment power" : "LED power",
                   light.power_relative_std),
        intensity * s.l(row, task.medium));
  }
}

// What the radiance calibration leaves open: each shot's black, the glare, the shutter.
void add_radiance(const RowContext& c, const ChannelObservation& o, std::size_t channel,
                  double l_predicted, Columns& columns, Entries& entries) {
  const OpenedShot& shot = c.shot;
  if (!c.rig.camera.radiance) return;
  const capture::RadianceCorrection& correction = c.rig.camera.radiance->correction;
  for (std::size_t k = 0; k < shot.exposures.size(); ++k) {
    const ShotExposure& e = shot.exposures[k];
    // What part of the row's l comes from this exposure.
    const double part = o.exposures.empty() ? 1.0 : o.exposures[k].of_row[c.row];
    if (e.black_std_counts > 0.0) {
      entries.emplace_back(columns.at("black " + e.file, "black level", e.black_std_counts),
                           part * shot.exposure_s / e.true_s * o.l_per_count[c.row]);
    }
    if (e.relative_std > 0.0) {
      entries.emplace_back(
          columns.at(fmt::format("exposure {:.4g}", e.stated_s), "exposure time", e.relative_std),
          part * l_predicted);
    }
  }
  if (correction.glare_std[channel] > 0.0) {
    entries.emplace_back(columns.at("glare", "veiling glare", correction.glare_std[channel]),
                         o.l_per_count[c.row] * shot.frame_mean_counts[channel]);
  }
}

// Changes of l by shifts of what the row's samples see: one column a nuisance of deviation 1, named
// `name` and counted.
void add_shifts(const RowContext& c, const Eigen::Matrix3Xd& shifts_mm, const std::string& name,
                const std::string& group, double intensity, const TaskSensitivity& task,
                Columns& columns, Entries& entries) {
  const auto row = static_cast<Eigen::Index>(c.row);
  const SeenObject& seen = *c.shot.seen;
  const auto along = tangents(seen.patches->normal(seen.map.patch_of_row[c.row]));
  for (Eigen::Index k = 0; k < shifts_mm.cols(); ++k) {
    double change = 0.0;
    for (std::size_t t = 0; t < 2; ++t) {
      change +=
          task.sensitivity->per_tangent_mm[t](row, task.medium) * along[t].dot(shifts_mm.col(k));
    }
    entries.emplace_back(columns.at(name + std::to_string(k), group, 1.0), intensity * change);
  }
}

// What pose and lens do to the row. The lens is one for all shots; where it was wrong, the pose was
// fitted through the wrong lens, too, and has taken up part of it (PoseResult::per_lens_parameter):
// the two go together. What the pose's own marks leave open is independent of that.
void add_view(const RowContext& c, double intensity, const TaskSensitivity& task, Columns& columns,
              Entries& entries) {
  const SeenObject& seen = *c.shot.seen;
  const Rigid3d& pose = c.shot.pose.camera_from_world;
  const Eigen::Vector3d& site_mm = seen.sites[c.row].center_mm;
  const Eigen::Vector3d& normal = seen.patches->normal(seen.map.patch_of_row[c.row]);
  const Eigen::Matrix<double, 3, 6> by_pose = surface_shift_by_pose(pose, site_mm, normal);
  // One pose for all shots, or one a shot.
  const std::string name =
      c.rig.pose.charuco || c.rig.pose.per_shot ? "pose " + c.shot.rig->file : "pose";
  add_shifts(c, by_pose * c.pose_root, name, "pose", intensity, task, columns, entries);
  if (c.lens_root.cols() == 0) return;
  const Eigen::Matrix<double, 3, calib::kLensParameters> by_lens =
      surface_shift_by_ray(pose, site_mm, normal) *
          calib::ray_per_lens_parameter(c.rig.camera.intrinsics, (pose * site_mm).hnormalized()) +
      by_pose * c.shot.pose.per_lens_parameter;
  add_shifts(c, by_lens * c.lens_root, "lens", "lens", intensity, task, columns, entries);
}

Entries row_entries(const RowContext& c, const ChannelObservation& o, std::size_t channel,
                    const std::map<LightKey, TaskSensitivity>& sensitivities, Columns& columns) {
  Entries entries;
  double l_predicted = 0.0;
  const double eta_std = c.shot.seen->object->rig->eta_std;
  for (const std::string& name : c.shot.rig->lights) {
    const RigLight& light = c.rig.light(name);
    const TaskSensitivity& task =
        sensitivities.at({c.shot.seen.get(), name, light.colours_differ() ? channel : 0});
    const double intensity = light.power()[static_cast<Eigen::Index>(channel)];
    const double ambient_std = light.ambient_std_W_per_mm2_sr[static_cast<Eigen::Index>(channel)];
    if (ambient_std > 0.0) {
      entries.emplace_back(columns.at(light.name + ".ambient", "ambient", ambient_std),
                           task.sensitivity->l(static_cast<Eigen::Index>(c.row), task.medium));
    }
    l_predicted += intensity * task.sensitivity->l(static_cast<Eigen::Index>(c.row), task.medium);
    if (light.is_ambient) continue;
    if (light.calibrated) {
      add_calibrated(c, light, channel, intensity, task, columns, entries);
    } else {
      add_light(c, light, intensity, task, columns, entries);
    }
    add_view(c, intensity, task, columns, entries);
    if (eta_std > 0.0) {
      entries.emplace_back(
          columns.at("eta", "eta", eta_std),
          intensity * task.sensitivity->per_eta(static_cast<Eigen::Index>(c.row), task.medium));
    }
  }
  add_radiance(c, o, channel, l_predicted, columns, entries);
  return entries;
}

}  // namespace

void add_nuisances(const Rig& rig, const std::vector<const OpenedShot*>& shots,
                   const std::vector<ChannelObservation>& rows, std::size_t channel,
                   const std::map<LightKey, TaskSensitivity>& sensitivities, DenseSystem& system) {
  Columns columns;
  std::vector<Entries> entries;
  std::map<std::string, SeenMatrix> led_root;
  const LensRoot of_lens = lens_root(rig.camera);
  for (const RigLight& light : rig.lights) {
    if (light.calibrated) led_root[light.name] = own_root(*light.calibrated, channel);
  }
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const OpenedShot* shot = shots[i];
    const Eigen::Matrix<double, 6, 6> root = covariance_root(shot->pose.covariance);
    const ChannelObservation& o = rows[i];
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      entries.push_back(row_entries({rig, *shot, j, root, led_root, of_lens}, o, channel,
                                    sensitivities, columns));
    }
  }
  system.nuisances = columns.list();
  system.nuisance_columns = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(entries.size()),
                                                  static_cast<Eigen::Index>(columns.list().size()));
  for (std::size_t j = 0; j < entries.size(); ++j) {
    for (const auto& [column, value] : entries[j]) {
      system.nuisance_columns(static_cast<Eigen::Index>(j), column) += value;
    }
  }
}

}  // namespace scattermeter::apps
