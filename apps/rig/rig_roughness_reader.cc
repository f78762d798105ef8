#include "apps/rig/rig_roughness_reader.h"

#include <string>
#include <variant>

#include "core/base/input_error.h"
#include "core/material/rough_boundary.h"

namespace scattermeter::apps {
namespace {

constexpr double kLeastAlpha = 0.01;
// That light enters and leaves a rough surface otherwise is then below 1 %.
constexpr double kMostGlossOfSmooth = 0.05;
// Of alpha, where its deviation is not stated.
constexpr double kRelativeStd = 0.3;

// Finishes of plastics. Ranges of what one word covers, not measured values: a polished face
// mirrors a lamp as a blot, a milled one shows its shine, a blasted or ground one has none.
struct Finish {
  const char* name;
  double alpha;
  double std;
};
constexpr Finish kFinishes[] = {
    {"polished", 0.03, 0.01}, {"as-milled", 0.15, 0.05}, {"matt", 0.35, 0.1}};

}  // namespace

void read_roughness(const YamlField& field, SceneObject& object) {
  if (field.is_scalar()) {
    const std::string name = field.text();
    for (const Finish& finish : kFinishes) {
      if (name != finish.name) continue;
      object.surface_alpha = finish.alpha;
      object.surface_alpha_std = finish.std;
      return;
    }
    field.fail("expected polished, as-milled, matt, or {alpha, alpha_std}");
  }
  field.only({"alpha", "alpha_std"});
  const YamlField alpha = field.at("alpha");
  object.surface_alpha = alpha.number(0.0, RoughBoundary::kMostAlpha);
  if (object.surface_alpha > 0.0 && object.surface_alpha < kLeastAlpha) {
    alpha.fail("expected 0 (smooth) or 0.01 to 0.5");
  }
  object.surface_alpha_std =
      field.number_or("alpha_std", kRelativeStd * object.surface_alpha, 0.0, 1.0);
  if (object.surface_alpha == 0.0 && object.surface_alpha_std > kMostGlossOfSmooth) {
    field.at("alpha_std").fail("expected at most 0.05 for a smooth surface (alpha 0)");
  }
}

void require_lights_of_rough_objects(const Scene& scene) {
  for (const SceneShot& shot : scene.shots) {
    if (!(scene.object(shot.object).surface_alpha > 0.0)) continue;
    for (const std::string& name : shot.lights) {
      if (!std::holds_alternative<DistantLight>(scene.light(name).kind)) continue;
      throw InputError(scene.at(shot.line) + ": shots.lights",
                       name + " is an environment, and object " + shot.object +
                           " is rough: what its surface reflects of a picture is not modelled");
    }
  }
}

}  // namespace scattermeter::apps
