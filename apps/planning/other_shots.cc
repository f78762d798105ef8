#include "apps/planning/other_shots.h"

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
constexpr double kStep_rad = 15.0 * kDegree;  // between places
constexpr double kKnownScale = 0.02;          // told in place of a free one
constexpr const char* kOtherLed = "another LED";

// Rings from the zenith to the horizon, evenly filled.
std::vector<Eigen::Vector3d> half_sphere() {
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

// An LED like this one, turned about the middle.
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

// The first LED of a shot of the object; null where there is none.
const SceneLight* led_of(const Rig& rig, const CoarseShot& shot) {
  for (const std::string& name : shot.rig.lights) {
    if (rig.scene.light(name).led() != nullptr) return &rig.scene.light(name);
  }
  return nullptr;
}

// The shot under this LED in place of its own; light of the room stays.
CoarseShot under(const Rig& rig, const CoarseShot& shot, const std::string& led,
                 const std::string& file) {
  CoarseShot out = shot;
  out.rig.file = file;
  out.rig.lights = {led};
  out.exposures_s.clear();
  for (const std::string& name : shot.rig.lights) {
    if (rig.scene.light(name)->is_fitted()) out.rig.lights.push_back(name);
  }
  return out;
}

// One material on its way.
struct Asked {
  const OtherShotsTask* task;
  std::vector<CoarseShot> shots;
  LitViews lit;
  std::optional<CoarseStd> planned;
  OtherShots out;

  double relative(const CoarseStd& of) const {
    return out.planned * of.sigma_a_per_mm / planned->sigma_a_per_mm;
  }
  void add(const std::string& what, const std::optional<CoarseStd>& with) {
    if (!with) return;
    out.gains.push_back({what, with->sigma_s_prime_per_mm / planned->sigma_s_prime_per_mm,
                         with->sigma_a_per_mm / planned->sigma_a_per_mm});
  }
  // The first shot of the object under an LED.
  const CoarseShot* shot_of(const Rig& rig, const std::string& object) const {
    for (const CoarseShot& shot : shots) {
      if (shot.rig.object == object && led_of(rig, shot) != nullptr) return &shot;
    }
    return nullptr;
  }
};

class OtherShotsSearch {
 public:
  OtherShotsSearch(const Rig& rig, const ScalePrior& scale, CoarseShots& coarse)
      : rig_(rig), scale_(scale), coarse_(coarse) {}

  Asked ask(const OtherShotsTask& task) {
    Asked a{&task, coarse_.shots_of(task.material.name), {}, {}, {}};
    a.out.material = task.material.name;
    a.out.channel = kRgbName[task.material.channel];
    a.out.planned = task.sigma_a_per_mm.std / task.sigma_a_per_mm.value;
    coarse_.add_lights(a.shots, a.lit);
    a.planned = coarse_.forecast(rig_, task.material, a.shots, a.lit, scale_);
    if (!a.planned) return a;
    a.out.coarse_ratio = a.planned->sigma_a_per_mm / task.sigma_a_per_mm.std;
    if (std::isinf(scale_.relative_std)) {
      a.add("a scale known to 2 %, which is free now", forecast(a, {kKnownScale}));
    } else if (scale_.relative_std > 0.0) {
      a.add(fmt::format("a scale twice as well known ({:.2g} %)", 50.0 * scale_.relative_std),
            forecast(a, {0.5 * scale_.relative_std}));
    }
    a.add("four times the light (more exposures, or longer ones where nothing clips)",
          coarse_.forecast(rig_, task.material, a.shots, a.lit, scale_, 0.25));
    for (const std::string& object : objects(a)) shadow(object, a);
    return a;
  }

  // All materials that have shots of the object share the light on it.
  void map(const std::string& object, std::vector<Asked>& asked, Progress* progress) {
    std::vector<std::pair<Asked*, std::size_t>> maps;
    for (Asked& a : asked) {
      const CoarseShot* shot = a.shot_of(rig_, object);
      if (!a.planned || shot == nullptr) continue;
      maps.emplace_back(&a, a.out.maps.size());
      LedMap& m = a.out.maps.emplace_back();
      const SceneLight& like = *led_of(rig_, *shot);
      m.object = object;
      m.like = like.name;
      m.center_mm = shot->seen->object->box.center_mm();
      m.distance_mm = (like.led()->led.position_mm - m.center_mm).norm();
      m.camera_mm = shot->seen->camera_center_mm;
      for (const CoarseShot& s : a.shots) {
        if (s.rig.object != object) continue;
        for (const std::string& name : s.rig.lights) {
          const SceneLight& light = rig_.scene.light(name);
          if (light.led() != nullptr) m.planned_mm.push_back(light.led()->led.position_mm);
        }
      }
    }
    if (maps.empty()) return;
    const std::vector<Eigen::Vector3d> directions = half_sphere();
    for (const auto& [a, i] : maps) a->out.maps[i].places.resize(directions.size());
    ProgressStage stage(progress, "LED positions", directions.size());
    tbb::parallel_for(std::size_t{0}, directions.size(), [&](std::size_t k) {
      // Materials that take after the same LED stand one after the other.
      Rig rig = rig_;
      rig.scene.lights.emplace_back();
      LitViews light;
      bool lit = false;
      std::string like;
      for (const auto& [a, i] : maps) {
        LedMap& m = a->out.maps[i];
        const CoarseShot& shot = *a->shot_of(rig_, object);
        if (m.like != like) {
          like = m.like;
          rig.scene.lights.back() = turned(rig_.scene.light(like), m.center_mm, directions[k]);
          lit =
              !shot.seen->object->rays->contains(rig.scene.lights.back().led()->led.position_mm) &&
              coarse_.add_led(*shot.seen, rig.scene.lights.back(), light);
        }
        m.places[k].position_mm = rig.scene.lights.back().led()->led.position_mm;
        if (!lit) continue;
        LitViews all = a->lit;
        for (const auto& [key, w] : light.weights) all.weights[key] = w;
        for (const auto& [key, c] : light.changed) all.changed[key] = c;
        std::vector<CoarseShot> shots = {under(rig, shot, kOtherLed, "one more shot")};
        if (const auto s = coarse_.forecast(rig, a->task->material, shots, all, scale_)) {
          m.places[k].alone = a->relative(*s);
        }
        shots.insert(shots.begin(), a->shots.begin(), a->shots.end());
        if (const auto s = coarse_.forecast(rig, a->task->material, shots, all, scale_)) {
          m.places[k].joined = a->relative(*s);
        }
      }
      stage.step();
    });
  }

  // The best place of every map as a gain; all in order.
  void finish(Asked& a) const {
    for (const LedMap& m : a.out.maps) {
      const auto better = [](const LedPlace& one, const LedPlace& other) {
        return std::isfinite(one.joined) && !(one.joined >= other.joined);
      };
      const auto best = std::min_element(m.places.begin(), m.places.end(), better);
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
  std::vector<std::string> objects(const Asked& a) const {
    std::vector<std::string> out;
    for (const CoarseShot& shot : a.shots) {
      if (std::find(out.begin(), out.end(), shot.rig.object) == out.end()) {
        out.push_back(shot.rig.object);
      }
    }
    return out;
  }

  std::optional<CoarseStd> forecast(const Asked& a, const ScalePrior& scale) const {
    return coarse_.forecast(rig_, a.task->material, a.shots, a.lit, scale);
  }

  // One more shot under the LED of the first, a card's edge across it: the better of two edges.
  void shadow(const std::string& object, Asked& a) {
    const CoarseShot* shot = a.shot_of(rig_, object);
    if (shot == nullptr) return;
    const SceneLight& led = *led_of(rig_, *shot);
    std::optional<CoarseStd> best;
    for (const bool upright : {true, false}) {
      const auto card = with_shadow_card(*shot->seen->object, led.led()->led.position_mm, upright);
      if (!card) return;
      auto seen = std::make_shared<SeenObject>(*shot->seen);
      seen->shadows = card.get();
      LitViews all = a.lit;
      if (!coarse_.add_led(*seen, led, all)) continue;
      CoarseShot half = under(rig_, *shot, led.name, "one more shot");
      for (const std::string& name : half.rig.lights) {
        if (name == led.name) continue;
        all.weights[{seen.get(), name, 0}] = all.weights.at({shot->seen.get(), name, 0});
        all.changed[{seen.get(), name, 0}] = all.changed.at({shot->seen.get(), name, 0});
      }
      half.seen = seen;
      std::vector<CoarseShot> shots = a.shots;
      shots.push_back(half);
      const auto with = coarse_.forecast(rig_, a.task->material, shots, all, scale_);
      if (with && (!best || with->sigma_a_per_mm < best->sigma_a_per_mm)) best = with;
    }
    a.add(fmt::format("one more shot of {} under {}, a card's shadow edge across its middle",
                      object, led.name),
          best);
  }

  const Rig& rig_;
  ScalePrior scale_;
  CoarseShots& coarse_;
};

}  // namespace

std::vector<OtherShots> other_shots(const Rig& rig, const std::vector<OtherShotsTask>& tasks,
                                    const ScalePrior& scale, CoarseShots& coarse,
                                    Progress* progress) {
  OtherShotsSearch search(rig, scale, coarse);
  std::vector<Asked> asked;
  for (const OtherShotsTask& task : tasks) asked.push_back(search.ask(task));
  for (const SceneObject& object : rig.scene.objects) search.map(object.name, asked, progress);
  std::vector<OtherShots> out;
  for (Asked& a : asked) {
    search.finish(a);
    out.push_back(a.out);
  }
  return out;
}

}  // namespace scattermeter::apps
