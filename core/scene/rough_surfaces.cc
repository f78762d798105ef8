#include "core/scene/rough_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/light/gloss.h"
#include "core/material/cosine_table.h"

namespace scattermeter {
namespace {

constexpr double kMostGloss = 0.05;
constexpr double kMediumAlbedo = 0.5;
// Step of the differences, of alpha.
constexpr double kStep = 0.25;

// The boundary's transmittances with alpha a step larger or smaller.
struct Transmittances {
  Transmittances(double alpha, double eta)
      : by_cosine([&](double c) { return RoughBoundary(alpha, eta).transmittance(c); }) {
    // 1 - F_dr, of ∫ 2 cos T(cos) dcos: F_dr = 1 - T / eta^2.
    double diffuse = 0.0;
    for (int k = 0; k < CosineTable::kSteps; ++k) {
      const double c = 0.5 * (CosineTable::cosine(k) + CosineTable::cosine(k + 1));
      diffuse += 2.0 * c * by_cosine(c) / CosineTable::kSteps;
    }
    const double passes = diffuse / (eta * eta);
    log_mismatch = std::log((2.0 - passes) / passes);
  }
  CosineTable by_cosine;
  double log_mismatch = 0;
};

double cosine_to(const Eigen::Vector3d& to_mm, const Eigen::Vector3d& at_mm,
                 const Eigen::Vector3d& normal) {
  return (to_mm - at_mm).normalized().dot(normal);
}

// By row of the map: mean over the LEDs' irradiances of ln T towards them, plus that towards the
// camera.
double log_passed(const Transmittances& t, const Scene& scene, const SceneShot& shot,
                  const SeenObject& seen, std::size_t channel, std::size_t row) {
  constexpr double kLeast = 0.05;  // of cosines
  const Eigen::Vector3d& at_mm = seen.sites[row].center_mm;
  const Eigen::Vector3d normal = seen.patches->normal_at(seen.map.patch_of_row[row], at_mm);
  const auto log_t = [&](const Eigen::Vector3d& to_mm) {
    return std::log(t.by_cosine(std::max(kLeast, cosine_to(to_mm, at_mm, normal))));
  };
  double sum = 0.0, entered = 0.0;
  for (const std::string& name : shot.lights) {
    const SceneLight& light = scene.light(name);
    if (light.led() == nullptr) continue;
    const Led& led = light.led()->led;
    const double irradiance = light->power()[static_cast<Eigen::Index>(channel)] *
                              led.transmitted_irradiance_per_mm2(at_mm, normal, 1.0);
    sum += irradiance;
    if (irradiance > 0.0) entered += irradiance * log_t(led.position_mm);
  }
  return log_t(seen.camera_center_mm) + (sum > 0.0 ? entered / sum : 0.0);
}

}  // namespace

RowGloss row_gloss(const Scene& scene, const SceneShot& shot, const SeenObject& seen,
                   std::size_t channel, double surface_alpha) {
  const auto n = static_cast<Eigen::Index>(seen.sites.size());
  RowGloss out{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const RoughBoundary boundary(surface_alpha, seen.object->stated->eta_int_over_ext);
  const RayScene& shadows = seen.shadowing();
  for (const std::string& name : shot.lights) {
    const SceneLight& light = scene.light(name);
    if (light.led() == nullptr) continue;
    const Led& led = light.led()->led;
    const double power = light->power()[static_cast<Eigen::Index>(channel)];
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto row = static_cast<std::size_t>(j);
      const Eigen::Vector3d& at_mm = seen.sites[row].center_mm;
      const Eigen::Vector3d normal = seen.patches->normal_at(seen.map.patch_of_row[row], at_mm);
      out.l[j] +=
          power * gloss_per_mm2(boundary, shadows, led, at_mm, normal, seen.camera_center_mm);
      out.irradiance[j] += power * led.transmitted_irradiance_per_mm2(at_mm, normal, 1.0);
    }
  }
  return out;
}

bool is_glossy(const RowGloss& gloss, std::size_t row) {
  const auto j = static_cast<Eigen::Index>(row);
  return gloss.l[j] > kMostGloss * kMediumAlbedo * gloss.irradiance[j];
}

RoughSurfaces::RoughSurfaces(const Scene& scene, std::size_t channel,
                             const std::vector<Rows>& rows) {
  Eigen::Index n = 0;
  for (const Rows& shot : rows) n += static_cast<Eigen::Index>(shot.rows.size());
  gloss_ = relative_ = log_mismatch_ = gloss_change_ = Eigen::VectorXd::Zero(n);
  std::map<const SceneObject*, std::pair<Transmittances, Transmittances>> by_object;
  Eigen::Index at = 0;
  for (const Rows& shot : rows) {
    const SceneObject& object = *shot.seen->object->stated;
    const double alpha = object.surface_alpha;
    const Eigen::Index first = at;
    at += static_cast<Eigen::Index>(shot.rows.size());
    if (!(alpha > 0.0)) continue;
    const double more = std::min(RoughBoundary::kMostAlpha, (1.0 + kStep) * alpha);
    const double less = (1.0 - kStep) * alpha;
    // The shots of an object share them.
    auto found = by_object.find(&object);
    if (found == by_object.end()) {
      const double eta = object.eta_int_over_ext;
      found = by_object
                  .emplace(&object, std::pair{Transmittances(more, eta), Transmittances(less, eta)})
                  .first;
    }
    const Transmittances& rougher = found->second.first;
    const Transmittances& smoother = found->second.second;
    const auto gloss_at = [&](double a) {
      return row_gloss(scene, *shot.shot, *shot.seen, channel, a).l;
    };
    const Eigen::VectorXd gloss = gloss_at(alpha);
    const Eigen::VectorXd gloss_step = gloss_at(more) - gloss_at(less);
    const double deviations = object.surface_alpha_std / (more - less);
    for (std::size_t i = 0; i < shot.rows.size(); ++i) {
      const Eigen::Index row = first + static_cast<Eigen::Index>(i);
      const auto of_map = static_cast<Eigen::Index>(shot.rows[i]);
      const auto passed = [&](const Transmittances& t) {
        return log_passed(t, scene, *shot.shot, *shot.seen, channel, shot.rows[i]);
      };
      gloss_[row] = gloss[of_map];
      gloss_change_[row] = deviations * gloss_step[of_map];
      relative_[row] = deviations * (passed(rougher) - passed(smoother));
      log_mismatch_[row] = deviations * (rougher.log_mismatch - smoother.log_mismatch);
    }
  }
}

Eigen::VectorXd RoughSurfaces::change(const Eigen::VectorXd& l,
                                      const Eigen::VectorXd& per_log_mismatch) const {
  return relative_.cwiseProduct(l) + log_mismatch_.cwiseProduct(per_log_mismatch) + gloss_change_;
}

}  // namespace scattermeter
