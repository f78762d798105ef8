#include "apps/looks/light_look.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "core/diffusion/dipole_curve.h"
#include "core/estimation/estimation.h"
#include "core/estimation/material_channel.h"

namespace scattermeter::apps {
namespace {

// The grid of media: sigma_s' in 1/mm, and 1 - albedo. A coloured material may be nearly black in
// one channel, of which the dipole still tells the brightness to a factor of two or so.
constexpr std::array kScattering = {0.2, 0.4, 0.7, 1.2, 2.0, 3.5, 6.0, 12.0};
constexpr std::array kAbsorbed = {0.0005, 0.002, 0.006, 0.02, 0.06, 0.2, 0.5, 0.8, 0.95, 0.99};
constexpr std::size_t kRows = 800;  // of an image, evenly
constexpr std::size_t kLeastRows = 20;
// Covered: rows whose prediction exceeds this share of the mean, and which show less than this
// share of it.
constexpr double kStrong = 0.3;
constexpr double kDark = 0.15;

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return names;
}

bool is_seen(RowState state) { return state == RowState::kUsed || state == RowState::kFloor; }

}  // namespace

LightLook::LightLook(const Scene& scene, LitObjects& lit, const std::vector<ObservedShot>& shots,
                     Weights& weights)
    : scene_(scene), lit_(lit), shots_(shots), weights_(weights), knots_(smooth_knots(lit)) {
  curves_.resize(knots_.size(), kScattering.size() * kAbsorbed.size());
  Eigen::Index medium = 0;
  const double eta = shots.empty() ? 1.4 : shots.front().seen->object->stated->eta_int_over_ext;
  for (const double s : kScattering) {
    for (const double q : kAbsorbed) {
      curves_.col(medium++) = dipole_curve(knots_, std::log(s / (1.0 - q)), q, eta).r;
    }
  }
  for (const SceneShot& shot : scene.shots) {
    const std::vector<std::string> lights = sorted(shot.lights);
    if (std::find(settings_.begin(), settings_.end(), lights) == settings_.end()) {
      settings_.push_back(lights);
    }
  }
  add_smooth_weights(scene, shots, lit, nullptr, weights);
}

std::size_t LightLook::best_channel(const Observation& observation) {
  std::size_t best = 0;
  for (std::size_t c = 1; c < kRgb; ++c) {
    if (observation.channel[c].rows_used > observation.channel[best].rows_used) best = c;
  }
  return best;
}

bool LightLook::add_weights_for(const SeenObject& seen, const SceneShot& stated,
                                const std::vector<std::string>& lights) {
  SceneShot other = stated;
  other.object = seen.object->stated->name;
  const bool all_reach = std::all_of(lights.begin(), lights.end(), [&](const std::string& name) {
    return lit_.reaches(other.object, name, 0);
  });
  if (!all_reach) return false;
  other.lights = lights;
  std::vector<ObservedShot> stub(1);
  stub[0].stated = &other;
  stub[0].seen = std::shared_ptr<const SeenObject>(std::shared_ptr<void>(), &seen);
  add_smooth_weights(scene_, stub, lit_, nullptr, weights_);
  return true;
}

LightLook::Match LightLook::match(const SeenObject& seen, const ChannelObservation& o,
                                  const std::vector<std::string>& lights,
                                  std::size_t channel) const {
  Match out;
  if (o.rows_used < kLeastRows) return out;
  std::vector<Eigen::Index> rows;
  const std::size_t stride = std::max<std::size_t>(1, o.rows_used / kRows);
  std::size_t n = 0;
  for (std::size_t j = 0; j < o.l.size(); ++j) {
    if (o.state[j] == RowState::kUsed && n++ % stride == 0) {
      rows.push_back(static_cast<Eigen::Index>(j));
    }
  }
  WeightMatrix w = WeightMatrix::Zero(static_cast<Eigen::Index>(rows.size()), curves_.rows());
  for (const std::string& name : lights) {
    const SceneLight& light = scene_.light(name);
    w += light->power()[static_cast<Eigen::Index>(channel)] *
         weights_.at({&seen, name, light.channel_of(channel)})(rows, Eigen::all);
  }
  const Eigen::MatrixXd images = w * curves_;
  const Eigen::VectorXd all =
      Eigen::Map<const Eigen::VectorXd>(o.l.data(), static_cast<Eigen::Index>(o.l.size()));
  const Eigen::VectorXd l = all(rows);
  const Eigen::ArrayXd lm = images.transpose() * l;
  const Eigen::ArrayXd mm = images.colwise().squaredNorm().transpose();
  out.scales = lm / mm.max(1e-300);
  out.rests = (1.0 - lm.square() / (l.squaredNorm() * mm).max(1e-300)).max(0.0).sqrt();
  out.rest = out.rests.minCoeff(&out.best);
  return out;
}

void LightLook::offer(double rest, const std::string& what, const std::vector<std::string>& lights,
                      ShotLikeness& out) const {
  if (!(rest < out.best_other)) return;
  out.best_other = rest;
  out.other = what;
  out.other_lights = lights;
}

ShotLikeness LightLook::likeness(std::size_t i) {
  const ObservedShot& shot = shots_[i];
  const std::size_t c = best_channel(shot.observation);
  ShotLikeness out;
  if (!shot_problem(shot, c).empty()) return out;
  const ChannelObservation& o = shot.observation.channel[c];
  const std::vector<std::string> own = sorted(shot.stated->lights);
  out.own = match(*shot.seen, o, own, c).rest;
  if (!(out.own > kDoubtfulImage)) return out;
  for (const std::vector<std::string>& lights : settings_for(own)) {
    if (lights == own || !add_weights_for(*shot.seen, *shot.stated, lights)) continue;
    offer(match(*shot.seen, o, lights, c).rest,
          fmt::format("lit by {}", fmt::join(lights, " and ")), lights, out);
  }
  return out;
}

// The sets of lights that a shot may have been taken under: those of the rig's shots, each LED
// alone, and one LED more than the stated ones.
std::vector<std::vector<std::string>> LightLook::settings_for(
    const std::vector<std::string>& own) const {
  std::vector<std::vector<std::string>> out = settings_;
  const auto add = [&](std::vector<std::string> lights) {
    lights = sorted(std::move(lights));
    if (std::find(out.begin(), out.end(), lights) == out.end()) out.push_back(std::move(lights));
  };
  for (const SceneLight& light : scene_.lights) {
    if (light.led() == nullptr) continue;
    add({light.name});
    if (std::find(own.begin(), own.end(), light.name) != own.end()) continue;
    std::vector<std::string> more = own;
    more.push_back(light.name);
    add(std::move(more));
  }
  return out;
}

void LightLook::compare_object(const SeenObject& seen, const Observation& observation,
                               std::size_t channel, ShotLikeness& out) {
  for (const std::vector<std::string>& lights : settings_) {
    if (!add_weights_for(seen, scene_.shots.front(), lights)) continue;
    offer(match(seen, observation.channel[channel], lights, channel).rest,
          fmt::format("of object {}, lit by {}", seen.object->stated->name,
                      fmt::join(lights, " and ")),
          lights, out);
  }
}

// Share of the strongly lit rows that are dark in the shot.
double LightLook::covered_share(std::size_t i, std::size_t c) const {
  const ObservedShot& shot = shots_[i];
  const ChannelObservation& o = shot.observation.channel[c];
  const std::vector<std::string> lights = sorted(shot.stated->lights);
  const Match own = match(*shot.seen, o, lights, c);
  if (!std::isfinite(own.rest)) return 0.0;
  Eigen::VectorXd predicted = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(o.l.size()));
  for (const std::string& name : lights) {
    const SceneLight& light = scene_.light(name);
    predicted +=
        light->power()[static_cast<Eigen::Index>(c)] *
        (weights_.at({shot.seen.get(), name, light.channel_of(c)}) * curves_.col(own.best));
  }
  std::vector<double> ratios;
  const double least = kStrong * predicted.mean();
  for (std::size_t j = 0; j < o.l.size(); ++j) {
    const double p = predicted[static_cast<Eigen::Index>(j)];
    if (is_seen(o.state[j]) && p > least) ratios.push_back(o.l[j] / p);
  }
  if (ratios.size() < kLeastRows) return 0.0;
  std::sort(ratios.begin(), ratios.end());
  const double usual = ratios[3 * ratios.size() / 4];
  const auto dark = std::lower_bound(ratios.begin(), ratios.end(), kDark * usual);
  return static_cast<double>(dark - ratios.begin()) / static_cast<double>(ratios.size());
}

}  // namespace scattermeter::apps
