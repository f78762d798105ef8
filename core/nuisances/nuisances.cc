#include "core/nuisances/nuisances.h"

#include <algorithm>
#include <numbers>
#include <utility>

#include <fmt/core.h>

#include "core/camera/lens.h"
#include "core/camera/vignetting.h"
#include "core/nuisances/even_light.h"
#include "core/nuisances/halo.h"
#include "core/nuisances/nuisance_columns.h"
#include "core/scene/rough_surfaces.h"
#include "core/scene/surroundings.h"

namespace scattermeter {

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

Eigen::VectorXd SceneNuisances::light_by_displacement(const ObservedShot& shot,
                                                      const std::vector<Eigen::Index>& rows) const {
  Eigen::VectorXd change = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows.size()));
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene_.light(name);
    const Eigen::VectorXd displacement = light->displacement();
    if (displacement.size() == 0) continue;
    const ChannelSensitivity& own =
        sensitivities_.at({shot.seen.get(), name, light.channel_of(channel_)});
    const double power = light->power()[static_cast<Eigen::Index>(channel_)];
    for (Eigen::Index k = 0; k < displacement.size(); ++k) {
      const Eigen::MatrixXd& by = own.sensitivity->per_change[static_cast<std::size_t>(k)];
      change -= power * displacement[k] * by(rows, own.medium);
    }
  }
  return change;
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

// The uncertainties of counts as a measure of light: each shot's black and pedestal, the shutter,
// the response, glare.
void SceneNuisances::add_radiance(const ObservedShot& shot, const ChannelObservation& observed,
                                  const Eigen::VectorXd& predicted, Columns& columns) const {
  const std::vector<Eigen::Index>& rows = columns.rows();
  const auto pick = [&](const std::vector<double>& of_row) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(of_row.data(),
                                             static_cast<Eigen::Index>(of_row.size()))(rows);
  };
  const Eigen::VectorXd l_per_count = pick(observed.l_per_count);
  const SceneSensor& sensor = scene_.camera.sensor;
  const double range_counts = sensor.white_counts - *std::min_element(sensor.black_counts.begin(),
                                                                      sensor.black_counts.end());
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
    if (scene_.camera.non_linearity_std > 0.0) {
      // The counts of a row of this exposure, as a share of the sensor's range.
      const Eigen::VectorXd filled =
          (e.true_s / shot.exposure_s / range_counts) *
          (l_per_count.array() > 0.0).select(predicted.array() / l_per_count.array(), 0.0).matrix();
      columns.add("non-linearity", "non-linearity", scene_.camera.non_linearity_std,
                  part.cwiseProduct(predicted).cwiseProduct(filled));
    }
  }
  const double glare_std = scene_.camera.glare_std[channel_];
  if (glare_std > 0.0) {
    columns.add("glare", "veiling glare", glare_std,
                shot.frame_mean_counts[channel_] * l_per_count);
  }
}

void SceneNuisances::add_even_light(const ObservedShot& shot, Columns& columns) const {
  const auto own = sensitivities_.find(even_light_key(shot));
  if (own == sensitivities_.end()) return;
  const double std = scene_.even_light_share_std *
                     facing_irradiance_W_per_mm2(scene_, shot, channel_) / std::numbers::pi;
  if (!(std > 0.0)) return;
  const LightSensitivity& s = *own->second.sensitivity;
  columns.add("even light " + shot.stated->file, "even light", std,
              columns.of(s.l, own->second.medium));
  // As it comes more from one side.
  for (std::size_t k = 0; k < s.per_change.size(); ++k) {
    columns.add(fmt::format("even light along {} {}", "xyz"[k], shot.stated->file), "even light",
                std, columns.of(s.per_change[k], own->second.medium));
  }
}

namespace {

Eigen::Vector2d pixel_of(const Lens& lens, const ObservedShot& shot, std::size_t row) {
  return lens.project(shot.pose.camera_from_world * shot.seen->sites[row].center_mm);
}

}  // namespace

void SceneNuisances::add_vignetting(const ObservedShot& shot, const Eigen::VectorXd& predicted,
                                    Columns& columns) const {
  const double std = scene_.camera.vignetting_std;
  if (!(std > 0.0)) return;
  const CameraIntrinsics& k = scene_.camera.intrinsics;
  const Lens lens(k);
  Vignetting frame = vignetting_of_frame(k.width_px, k.height_px);
  frame.radial[channel_] = {1.0};
  Eigen::VectorXd change = predicted;
  for (Eigen::Index i = 0; i < change.size(); ++i) {
    const auto row = static_cast<std::size_t>(columns.rows()[static_cast<std::size_t>(i)]);
    const Eigen::Vector2d at_px = pixel_of(lens, shot, row);
    change[i] *= frame.share(at_px.x(), at_px.y(), channel_) - 1.0;
  }
  columns.add("vignetting", "vignetting", std, change);
}

// The background beside the object tells how strong it may be: all of what is brighter there is one
// deviation.
void SceneNuisances::add_halo(const ObservedShot& shot, const ChannelObservation& observed,
                              Columns& columns) const {
  constexpr double kMost = 0.02;
  if (shot.exposures.empty() || !(shot.exposures.front().beside_counts[channel_] > 0.0)) return;
  const Lens lens(scene_.camera.intrinsics);
  std::vector<Eigen::Vector2d> at_px;
  Eigen::VectorXd counts(static_cast<Eigen::Index>(shot.seen->sites.size()));
  for (std::size_t row = 0; row < shot.seen->sites.size(); ++row) {
    at_px.push_back(pixel_of(lens, shot, row));
    const double per_count = observed.l_per_count[row];
    counts[static_cast<Eigen::Index>(row)] =
        per_count > 0.0 ? std::max(0.0, observed.l[row] / per_count) : 0.0;
  }
  const Halo whole = halo(at_px, counts);
  if (!(whole.beside_counts > 0.0)) return;
  const double std =
      std::min(kMost, shot.exposures.front().beside_counts[channel_] / whole.beside_counts);
  const Eigen::VectorXd l = whole.counts.cwiseProduct(
      Eigen::Map<const Eigen::VectorXd>(observed.l_per_count.data(), counts.size()));
  columns.add("halo " + shot.stated->file, "halo", std, l(columns.rows()));
}

// Far from the mirror direction, gloss is in proportion to alpha^2: it varies as a whole.
void SceneNuisances::add_gloss(const ObservedShot& shot, Columns& columns) const {
  const SceneObject& object = *shot.seen->object->stated;
  if (object.surface_alpha > 0.0 || !(object.surface_alpha_std > 0.0)) return;
  columns.add("gloss of " + object.name, "roughness", 1.0,
              row_gloss(scene_, *shot.stated, *shot.seen, channel_, object.surface_alpha_std)
                  .l(columns.rows()));
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
    const SeenChange change = seen_change(shot, rows);
    add_view(shot, change, columns);
    add_place(shot, change, columns);
    add_blur(shot, columns);
    add_even_light(shot, columns);
    add_gloss(shot, columns);
    columns.add("eta", "eta", eta_std, per_eta);
  }
  const Eigen::VectorXd by_albedo = change_by_albedo(shot, rows);
  if (by_albedo.size() > 0) {
    const ScenePlane plane = plane_below(scene_, *shot.seen->object);
    const double std = plane.albedo_std[static_cast<Eigen::Index>(channel_)];
    if (std > 0.0) columns.add("plane albedo", "surroundings", std, by_albedo);
  }
  add_radiance(shot, observed, predicted, columns);
  add_vignetting(shot, predicted, columns);
  add_halo(shot, observed, columns);
  return columns.take();
}

}  // namespace scattermeter
