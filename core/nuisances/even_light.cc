#include "core/nuisances/even_light.h"

#include <algorithm>

#include "core/light/ambient_light.h"

namespace scattermeter {
namespace {

// Smooth light: patches of a twelfth of the object.
PatchMesh coarse_patches(const SeenObject& seen) {
  const ObjectScene& object = *seen.object;
  return PatchMesh(object.mesh(),
                   std::max(2.0 * seen.patches->patch_size_mm(), object.size_mm() / 12.0));
}

}  // namespace

LightKey even_light_key(const ObservedShot& shot) { return {shot.seen.get(), "", 0}; }

bool may_have_even_light(const Scene& scene, const ObservedShot& shot) {
  const std::vector<std::string>& names = shot.stated->lights;
  const auto any = [&](const auto& is) {
    return std::any_of(names.begin(), names.end(),
                       [&](const std::string& name) { return is(scene.light(name)); });
  };
  return scene.even_light_share_std > 0.0 &&
         any([](const SceneLight& l) { return l.led() != nullptr; }) &&
         !any([](const SceneLight& l) { return l->is_fitted(); });
}

Eigen::MatrixXd even_light_images(const SeenObject& seen, const DistanceKnots& knots,
                                  const std::vector<LitMedium>& media, WeightStore* store) {
  const ObjectScene& object = *seen.object;
  return coarse_images(
      object, sites_at_centers(seen),
      AmbientLight().illuminate(coarse_patches(seen), seen.shadowing(),
                                object.stated->eta_int_over_ext, LightUse::kBudget)[0],
      knots, media, store);
}

std::array<Eigen::MatrixXd, 3> light_from_axes_images(const SeenObject& seen,
                                                      const DistanceKnots& knots,
                                                      const std::vector<LitMedium>& media,
                                                      const Eigen::MatrixXd& even,
                                                      WeightStore* store) {
  const ObjectScene& object = *seen.object;
  const std::vector<ExitSite> sites = sites_at_centers(seen);
  const std::array<IncidentLight, 3> lights = illuminate_more_from_axes(
      coarse_patches(seen), seen.shadowing(), object.stated->eta_int_over_ext);
  std::array<Eigen::MatrixXd, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = coarse_images(object, sites, lights[k], knots, media, store) - even;
  }
  return out;
}

double facing_irradiance_W_per_mm2(const Scene& scene, const ObservedShot& shot,
                                   std::size_t channel) {
  const Eigen::Vector3d center_mm = shot.seen->object->box.center_mm();
  double sum = 0.0;
  for (const std::string& name : shot.stated->lights) {
    const SceneLight& light = scene.light(name);
    if (light.led() == nullptr) continue;
    const Led& led = light.led()->led;
    const Eigen::Vector3d to_object = center_mm - led.position_mm;
    sum += light->power()[static_cast<Eigen::Index>(channel)] * led.lobe(to_object.normalized()) /
           to_object.squaredNorm();
  }
  return sum;
}

}  // namespace scattermeter
