#include "apps/planning/shot_forecaster.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "apps/simulation/chosen_exposure.h"
#include "capture/sensor/ideal_samples.h"
#include "capture/sensor/virtual_sensor.h"
#include "core/camera/sensor_noise.h"
#include "core/diffusion/dipole_curve.h"
#include "core/estimation/channel_image.h"
#include "core/fit/fit_uncertainty.h"
#include "core/light/incident_light.h"
#include "core/view/row_selection.h"

namespace scattermeter::apps {
namespace {

constexpr double kLongestExposure_s = 30.0;
constexpr std::size_t kMinRows = 20;

// Sets o.l to the expected light and its variance to that of these exposures together. Read noise
// counts once per exposure and falls with the square of its time, photon noise with the time.
void expose_rows(const Eigen::VectorXd& l, const std::vector<double>& exposures_s,
                 double range_counts, ChannelObservation& o) {
  for (std::size_t j = 0; j < o.l.size(); ++j) {
    const double photons = o.variance_per_l[j];
    const double read = std::max(0.0, o.variance[j] - photons * o.l[j]);
    const double counts_per_s = l[static_cast<Eigen::Index>(j)] / o.l_per_count[j];
    double information = 0.0;
    double open_s = 0.0;
    o.l[j] = l[static_cast<Eigen::Index>(j)];
    for (const double t : exposures_s) {
      if (!(counts_per_s * t < range_counts)) continue;
      information += 1.0 / (read / (t * t) + photons * o.l[j] / t);
      open_s += t;
    }
    o.l_per_count[j] /= exposures_s.front();
    if (o.state[j] != RowState::kUsed) continue;
    if (!(information > 0.0)) {
      leave_out(o, j, RowState::kClipped);
      continue;
    }
    o.variance[j] = 1.0 / information;
    o.variance_per_l[j] = photons / open_s;
  }
}

}  // namespace

ShotForecaster::ShotForecaster(const Rig& rig, const ObjectScenes& objects,
                               const std::vector<ObservedShot>& opened, double patch_size_mm,
                               double measured_patch_mm,
                               const std::array<double, kRgb>& responsivity,
                               const std::array<SensorNoise, kRgb>& noise, double range_counts)
    : rig_(rig),
      opened_(opened),
      measured_patch_mm_(measured_patch_mm),
      lit_(rig.scene, objects, patch_size_mm, 0.0),
      view_(see_all(rig.scene, objects, lit_, opened.front().pose)),
      knots_(smooth_knots(lit_)),
      range_counts_(range_counts) {
  for (const auto& [name, seen] : view_.objects) {
    const SampleMap& map = seen->map;
    const std::vector<float> uniform(
        static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height),
        static_cast<float>(0.5 * range_counts));
    for (std::size_t c = 0; c < kRgb; ++c) {
      capture::SensorModel sensor =
          capture::VirtualSensor(rig.scene, rig.truth.sensor, false).model();
      sensor.noise = noise[c];
      CfaSamples samples = capture::ideal_samples(uniform, map.x0, map.y0, map.width, map.height,
                                                  sensor, rig.scene.camera.sensor.cfa, 1.0);
      samples.variance_per_count = 1.0 / noise[c].gain_e_per_count;
      per_second_[name].channel[c] = observe(samples, map, responsivity).channel[c];
    }
  }
}

std::shared_ptr<const SeenObject> ShotForecaster::seen(const std::string& object) const {
  return view_.objects.at(object);
}

std::vector<CandidateShot> ShotForecaster::shots_of(const std::string& material) const {
  std::vector<CandidateShot> out;
  for (const ObservedShot& shot : opened_) {
    if (shot.stated->material != material) continue;
    CandidateShot& coarse = out.emplace_back();
    coarse.stated = *shot.stated;
    coarse.seen = seen(shot.stated->object);
    coarse.like = &shot;
    for (const ShotExposure& e : shot.exposures) coarse.exposures_s.push_back(e.true_s);
  }
  return out;
}

void ShotForecaster::add_lights(const std::vector<CandidateShot>& shots, ViewWeights& lit) {
  std::vector<ObservedShot> list;
  for (const CandidateShot& shot : shots) {
    ObservedShot& o = list.emplace_back();
    o.stated = &shot.stated;
    o.seen = shot.seen;
  }
  add_weights(
      rig_.scene, list, lit_, nullptr,
      [&](const SeenObject& seen, const SourceCloud& sources) {
        return smooth_weights(seen.sites, sources, knots_, coarse_pair_options(knots_));
      },
      lit.weights);
  for (const auto& [key, weights] : lit.weights) {
    if (lit.changed.contains(key)) continue;
    const auto& [seen, light, channel] = key;
    lit.changed[key] = changed_weights(*seen, rig_.scene.light(light), channel, lit_, knots_);
  }
}

bool ShotForecaster::add_led(const SeenObject& seen, const SceneLight& led, ViewWeights& lit) {
  const ObjectScene& object = *seen.object;
  const RayScene& shadows = seen.shadowing();
  const IncidentLight light = led->illuminate(
      *seen.patches, shadows, object.stated->eta_int_over_ext, LightUse::kMeasure)[0];
  if (light.lit.empty()) return false;
  const LightKey key{&seen, led.name, 0};
  lit.weights[key] = smooth_weights(seen.sites, SourceCloud(light, object.box.center_mm()), knots_,
                                    coarse_pair_options(knots_));
  lit.changed[key] = changed_weights(seen, led, 0, lit_, knots_);
  return true;
}

ObservedShot ShotForecaster::open(const Rig& rig, const ExpectedMaterial& material,
                                  const CandidateShot& shot, const ViewWeights& lit) const {
  std::array<Eigen::VectorXd, kRgb> l;
  const Observation& uniform = per_second_.at(shot.stated.object);
  double fastest = 0.0;  // counts per s
  for (std::size_t c = 0; c < kRgb; ++c) {
    const Medium& m = material.media[c];
    const double sigma_t = m.sigma_t_prime_per_mm();
    const DipoleCurve curve =
        dipole_curve(knots_, std::log(sigma_t), m.sigma_a_per_mm / sigma_t, material.eta);
    l[c] = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(shot.seen->sites.size()));
    for (const std::string& name : shot.stated.lights) {
      const SceneLight& light = rig.scene.light(name);
      const std::size_t own = light.channel_of(c);
      l[c] += light->power()[static_cast<Eigen::Index>(c)] *
              (lit.weights.at({shot.seen.get(), name, own}) * curve.r);
    }
    const ChannelObservation& o = uniform.channel[c];
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      fastest = std::max(fastest, l[c][static_cast<Eigen::Index>(j)] / o.l_per_count[j]);
    }
  }
  ObservedShot out;
  out.stated = &shot.stated;
  out.seen = shot.seen;
  out.pose = shot.like->pose;
  std::vector<double> exposures_s = shot.exposures_s;
  if (exposures_s.empty()) {
    exposures_s = {fastest > 0.0
                       ? std::min(kLongestExposure_s, kExposedTo * range_counts_ / fastest)
                       : kLongestExposure_s};
  }
  out.exposure_s = exposures_s.front();
  out.frame_mean_counts = shot.like->frame_mean_counts;
  if (!shot.like->exposures.empty()) {
    // The uncertainties that the files of a bracket share.
    ShotExposure e = shot.like->exposures.front();
    e.file = shot.stated.file;
    e.true_s = out.exposure_s;
    out.exposures = {e};
  }
  ChannelObservation& o = out.observation.channel[material.channel];
  o = uniform.channel[material.channel];
  expose_rows(l[material.channel], exposures_s, range_counts_, o);
  return out;
}

std::optional<ForecastStd> ShotForecaster::forecast(const Rig& rig,
                                                    const ExpectedMaterial& material,
                                                    const std::vector<CandidateShot>& shots,
                                                    const ViewWeights& lit, const ScalePrior& scale,
                                                    double noise_inflation) const {
  std::vector<ObservedShot> opened;
  opened.reserve(shots.size());
  MaterialChannel expected{material.name, material.channel, {}, material.eta};
  for (const CandidateShot& shot : shots) {
    opened.push_back(open(rig, material, shot, lit));
    expected.shots.push_back(&opened.back());
  }
  ChannelRows rows = channel_rows(rig.scene, expected);
  std::size_t used = 0;
  for (ChannelObservation& o : rows) {
    std::vector<double> l;
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] == RowState::kUsed) l.push_back(o.l[j]);
    }
    expect(o, Eigen::Map<const Eigen::VectorXd>(l.data(), static_cast<Eigen::Index>(l.size())));
    used += o.rows_used;
  }
  if (used < kMinRows) return std::nullopt;
  const Medium& medium = material.media[material.channel];
  const LitMedium first{{medium.sigma_s_prime_per_mm, medium.sigma_a_per_mm, 1.0}, 1.0};
  std::map<LightKey, LightSensitivity> of_light;
  std::map<LightKey, ChannelSensitivity> of_channel;
  for (const CandidateShot& shot : shots) {
    for (const std::string& name : shot.stated.lights) {
      const LightKey key{shot.seen.get(), name, rig.scene.light(name).channel_of(material.channel)};
      const auto [it, is_new] = of_light.try_emplace(key);
      if (is_new)
        it->second = sensitivity(*shot.seen, lit.weights.at(key),
                                 changed_images(*shot.seen, lit.changed.at(key), knots_, {first}),
                                 {first}, knots_);
      of_channel[key] = {&it->second, 0};
    }
  }
  const DenseSystem system = stacked(ChannelImage(rig.scene, expected, rows, lit.weights, knots_,
                                                  first, of_channel, measured_patch_mm_));
  // The whitened rows themselves are a root of the information.
  RecoveredReflectance whitened_rows;
  const Eigen::VectorXd weight = system.std_l.cwiseInverse();
  const Eigen::Index n_knots = system.weights.cols();
  Eigen::MatrixXd& root = whitened_rows.sqrt_information;
  root.resize(system.l.size(), n_knots + system.nuisance_columns.cols());
  root.leftCols(n_knots) = weight.asDiagonal() * system.weights;
  root.rightCols(system.nuisance_columns.cols()) = weight.asDiagonal() * system.nuisance_columns;
  whitened_rows.whitened = weight.cwiseProduct(system.l);
  const double sigma_t = medium.sigma_t_prime_per_mm();
  const double u = std::log(sigma_t);
  const double q = medium.sigma_a_per_mm / sigma_t;
  const FitUncertainty fit(whitened_rows, system.nuisances,
                           dipole_curve(knots_, u, q, material.eta), u, q, 1.0, scale,
                           noise_inflation);
  const Eigen::Matrix2d covariance = fit.covariance([](const std::string&) { return false; });
  const ForecastStd out{std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1))};
  if (!std::isfinite(out.sigma_s_prime_per_mm) || !std::isfinite(out.sigma_a_per_mm)) {
    return std::nullopt;
  }
  return out;
}

}  // namespace scattermeter::apps
