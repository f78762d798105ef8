#include "apps/planning/suggested_shots.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/core.h>
#include <oneapi/tbb/parallel_for.h>

#include "apps/planning/shadow_card.h"
#include "core/base/progress.h"

namespace scattermeter::apps {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kStep_rad = 15.0 * kDegree;  // between positions
constexpr double kKnownScale = 0.02;          // assumed in place of a free scale
constexpr const char* kOtherLed = "another LED";

// Directions of the upper hemisphere: rings from the zenith to the horizon, evenly filled.
std::vector<Eigen::Vector3d> upper_hemisphere() {
  std::vector<Eigen::Vector3d> out;
  for (int ring = 0; ring * kStep_rad < 0.501 * std::numbers::pi; ++ring) {
    const double zenith = ring * kStep_rad;
    const int n = std::max(
        1, static_cast<int>(std::lround(2.0 * std::numbers::pi * std::sin(zenith) / kStep_rad)));
    for (int k = 0; k < n; ++k) {
      const double azimuth = 2.0 * std::numbers::pi * k / n;
      out.emplace_back(std::sin(zenith) * std::cos(azimuth), std::sin(zenith) * std::sin(azimuth),
                       std::cos(zenith));
    }
  }
  return out;
}

// An LED like this one, moved to this direction from the centre and aimed at the centre.
SceneLight turned(const SceneLight& like, const Eigen::Vector3d& center_mm,
                  const Eigen::Vector3d& direction) {
  SceneLight out = like;
  out.name = kOtherLed;
  const Eigen::Vector3d offset_mm = like.led()->led.position_mm - center_mm;
  const Eigen::Matrix3d turn =
      Eigen::Quaterniond::FromTwoVectors(offset_mm, direction).toRotationMatrix();
  out.led()->led.position_mm = center_mm + offset_mm.norm() * direction;
  const Eigen::Quaterniond aim =
      Eigen::Quaterniond::FromTwoVectors(turn * like.led()->led.axis, -direction);
  out.led()->led.axis = -direction;
  if (!out.led()->calibrated) return out;
  LedUncertainty& u = *out.led()->calibrated;
  LedMatrix whole = LedMatrix::Identity();
  whole.topLeftCorner<3, 3>() = turn;
  u.covariance = whole * u.covariance * whole.transpose();
  u.common = whole * u.common;
  for (Eigen::Vector3d& tangent : u.tangents) tangent = aim * (turn * tangent);
  return out;
}

// The first LED of a shot; null if there is none.
const SceneLight* led_of(const Rig& rig, const CandidateShot& shot) {
  for (const std::string& name : shot.stated.lights) {
    if (rig.scene.light(name).led() != nullptr) return &rig.scene.light(name);
  }
  return nullptr;
}

// The shot with its LEDs replaced by this one; ambient light stays.
CandidateShot under(const Rig& rig, const CandidateShot& shot, const std::string& led,
                    const std::string& file) {
  CandidateShot out = shot;
  out.stated.file = file;
  out.stated.lights = {led};
  out.exposures_s.clear();
  for (const std::string& name : shot.stated.lights) {
    if (rig.scene.light(name)->is_fitted()) out.stated.lights.push_back(name);
  }
  return out;
}

// The search for one material.
struct MaterialSearch {
  const SuggestionRequest* request;
  std::vector<CandidateShot> shots;
  ViewWeights lit;
  std::optional<ForecastStd> planned;
  SuggestedShots out;

  double relative(const ForecastStd& of) const {
    return out.planned * of.sigma_a_per_mm / planned->sigma_a_per_mm;
  }
  void add(const std::string& what, const std::optional<ForecastStd>& with) {
    if (!with) return;
    out.gains.push_back({what, with->sigma_s_prime_per_mm / planned->sigma_s_prime_per_mm,
                         with->sigma_a_per_mm / planned->sigma_a_per_mm});
  }
  // The first shot of the object under an LED.
  const CandidateShot* shot_of(const Rig& rig, const std::string& object) const {
    for (const CandidateShot& shot : shots) {
      if (shot.stated.object == object && led_of(rig, shot) != nullptr) return &shot;
    }
    return nullptr;
  }
};

class SuggestionSearch {
 public:
  SuggestionSearch(const Rig& rig, const ScalePrior& scale, ShotForecaster& forecaster)
      : rig_(rig), scale_(scale), forecaster_(forecaster) {}

  MaterialSearch begin(const SuggestionRequest& request) {
    MaterialSearch a{&request, forecaster_.shots_of(request.material.name), {}, {}, {}};
    a.out.material = request.material.name;
    a.out.channel = kRgbName[request.material.channel];
    a.out.planned = request.sigma_a_per_mm.std / request.sigma_a_per_mm.value;
    forecaster_.add_lights(a.shots, a.lit);
    a.planned = forecaster_.forecast(rig_, request.material, a.shots, a.lit, scale_);
    if (!a.planned) return a;
    a.out.coarse_ratio = a.planned->sigma_a_per_mm / request.sigma_a_per_mm.std;
    if (std::isinf(scale_.relative_std)) {
      a.add("a scale known to 2 %, which is free now", forecast(a, {kKnownScale}));
    } else if (scale_.relative_std > 0.0) {
      a.add(fmt::format("a scale twice as well known ({:.2g} %)", 50.0 * scale_.relative_std),
            forecast(a, {0.5 * scale_.relative_std}));
    }
    a.add("four times the light (more exposures, or longer ones where nothing clips)",
          forecaster_.forecast(rig_, request.material, a.shots, a.lit, scale_, 0.25));
    for (const std::string& object : objects(a)) shadow(object, a);
    return a;
  }

  // The maps of one object; materials with the same LED share the light on it.
  void map(const std::string& object, std::vector<MaterialSearch>& searches, Progress* progress) {
    std::vector<std::pair<MaterialSearch*, std::size_t>> maps;
    for (MaterialSearch& a : searches) {
      const CandidateShot* shot = a.shot_of(rig_, object);
      if (!a.planned || shot == nullptr) continue;
      maps.emplace_back(&a, a.out.maps.size());
      LedMap& m = a.out.maps.emplace_back();
      const SceneLight& like = *led_of(rig_, *shot);
      m.object = object;
      m.like = like.name;
      m.center_mm = shot->seen->object->box.center_mm();
      m.distance_mm = (like.led()->led.position_mm - m.center_mm).norm();
      m.camera_mm = shot->seen->camera_center_mm;
      for (const CandidateShot& s : a.shots) {
        if (s.stated.object != object) continue;
        for (const std::string& name : s.stated.lights) {
          const SceneLight& light = rig_.scene.light(name);
          if (light.led() != nullptr) m.planned_mm.push_back(light.led()->led.position_mm);
        }
      }
    }
    if (maps.empty()) return;
    const std::vector<Eigen::Vector3d> directions = upper_hemisphere();
    for (const auto& [a, i] : maps) a->out.maps[i].positions.resize(directions.size());
    ProgressStage stage(progress, "LED positions", directions.size());
    tbb::parallel_for(std::size_t{0}, directions.size(), [&](std::size_t k) {
      // Consecutive materials with the same LED share its weights.
      Rig rig = rig_;
      rig.scene.lights.emplace_back();
      ViewWeights light;
      bool lit = false;
      std::string like;
      for (const auto& [a, i] : maps) {
        LedMap& m = a->out.maps[i];
        const CandidateShot& shot = *a->shot_of(rig_, object);
        if (m.like != like) {
          like = m.like;
          rig.scene.lights.back() = turned(rig_.scene.light(like), m.center_mm, directions[k]);
          lit =
              !shot.seen->object->rays->contains(rig.scene.lights.back().led()->led.position_mm) &&
              forecaster_.add_led(*shot.seen, rig.scene.lights.back(), light);
        }
        m.positions[k].position_mm = rig.scene.lights.back().led()->led.position_mm;
        if (!lit) continue;
        ViewWeights all = a->lit;
        for (const auto& [key, w] : light.weights) all.weights[key] = w;
        for (const auto& [key, c] : light.changed) all.changed[key] = c;
        std::vector<CandidateShot> shots = {under(rig, shot, kOtherLed, "one more shot")};
        if (const auto s = forecaster_.forecast(rig, a->request->material, shots, all, scale_)) {
          m.positions[k].alone = a->relative(*s);
        }
        shots.insert(shots.begin(), a->shots.begin(), a->shots.end());
        if (const auto s = forecaster_.forecast(rig, a->request->material, shots, all, scale_)) {
          m.positions[k].joined = a->relative(*s);
        }
      }
      stage.step();
    });
  }

  // Adds the best position of every map to the gains and sorts them.
  void finish(MaterialSearch& a) const {
    for (const LedMap& m : a.out.maps) {
      const auto better = [](const LedPosition& one, const LedPosition& other) {
        return std::isfinite(one.joined) && !(one.joined >= other.joined);
      };
      const auto best = std::min_element(m.positions.begin(), m.positions.end(), better);
      if (!std::isfinite(best->joined)) continue;
      const Eigen::Vector3d& at = best->position_mm;
      Gain gain{fmt::format("one more shot of {}, its LED at ({:.0f}, {:.0f}, {:.0f}) mm", m.object,
                            at.x(), at.y(), at.z()),
                std::numeric_limits<double>::quiet_NaN(), best->joined / a.out.planned};
      a.out.gains.push_back(gain);
    }
    std::stable_sort(a.out.gains.begin(), a.out.gains.end(), [](const Gain& x, const Gain& y) {
      return x.sigma_a_ratio < y.sigma_a_ratio;
    });
  }

 private:
  std::vector<std::string> objects(const MaterialSearch& a) const {
    std::vector<std::string> out;
    for (const CandidateShot& shot : a.shots) {
      if (std::find(out.begin(), out.end(), shot.stated.object) == out.end()) {
        out.push_back(shot.stated.object);
      }
    }
    return out;
  }

  std::optional<ForecastStd> forecast(const MaterialSearch& a, const ScalePrior& scale) const {
    return forecaster_.forecast(rig_, a.request->material, a.shots, a.lit, scale);
  }

  // A further shot under the LED of the first with a card's shadow edge across the object: the
  // better of two directions of the edge.
  void shadow(const std::string& object, MaterialSearch& a) {
    const CandidateShot* shot = a.shot_of(rig_, object);
    if (shot == nullptr) return;
    const SceneLight& led = *led_of(rig_, *shot);
    std::optional<ForecastStd> best;
    for (const bool upright : {true, false}) {
      const auto card = with_shadow_card(*shot->seen->object, led.led()->led.position_mm, upright);
      if (!card) return;
      auto seen = std::make_shared<SeenObject>(*shot->seen);
      seen->shadows = card.get();
      ViewWeights all = a.lit;
      if (!forecaster_.add_led(*seen, led, all)) continue;
      CandidateShot half = under(rig_, *shot, led.name, "one more shot");
      for (const std::string& name : half.stated.lights) {
        if (name == led.name) continue;
        all.weights[{seen.get(), name, 0}] = all.weights.at({shot->seen.get(), name, 0});
        all.changed[{seen.get(), name, 0}] = all.changed.at({shot->seen.get(), name, 0});
      }
      half.seen = seen;
      std::vector<CandidateShot> shots = a.shots;
      shots.push_back(half);
      const auto with = forecaster_.forecast(rig_, a.request->material, shots, all, scale_);
      if (with && (!best || with->sigma_a_per_mm < best->sigma_a_per_mm)) best = with;
    }
    a.add(fmt::format("one more shot of {} under {}, a card's shadow edge across its middle",
                      object, led.name),
          best);
  }

  const Rig& rig_;
  ScalePrior scale_;
  ShotForecaster& forecaster_;
};

}  // namespace

std::vector<SuggestedShots> suggested_shots(const Rig& rig,
                                            const std::vector<SuggestionRequest>& requests,
                                            const ScalePrior& scale, ShotForecaster& forecaster,
                                            Progress* progress) {
  SuggestionSearch search(rig, scale, forecaster);
  std::vector<MaterialSearch> searches;
  for (const SuggestionRequest& request : requests) searches.push_back(search.begin(request));
  for (const SceneObject& object : rig.scene.objects) search.map(object.name, searches, progress);
  std::vector<SuggestedShots> out;
  for (MaterialSearch& a : searches) {
    search.finish(a);
    out.push_back(a.out);
  }
  return out;
}

}  // namespace scattermeter::apps
