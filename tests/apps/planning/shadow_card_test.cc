#include "apps/planning/shadow_card.h"

#include <gtest/gtest.h>

#include "core/light/incident_light.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

TEST(ShadowCard, TakesAboutHalfTheLight) {
  const Rig rig = body_rig("cube", 1);
  const ObjectScenes scenes = bodies_scenes(rig);
  const ObjectScene& cube = scenes.at("cube");
  const PatchMesh patches(cube.mesh(), 1.0);
  const Led& led = rig.scene.lights[0].led()->led;
  const auto power = [&](const RayScene& shadows) {
    double sum = 0.0;
    for (const double p : illuminate(patches, shadows, led, 1.4).patch_power_sr) sum += p;
    return sum;
  };
  for (const bool upright : {true, false}) {
    const auto card = with_shadow_card(cube, led.position_mm, upright);
    ASSERT_NE(card, nullptr);
    EXPECT_EQ(mesh_problem(card->mesh()), "");
    const double share = power(*card) / power(*cube.rays);
    EXPECT_GT(share, 0.25);
    EXPECT_LT(share, 0.75);
  }
  EXPECT_EQ(with_shadow_card(cube, {0, 0, 30}, true), nullptr);
}

}  // namespace
}  // namespace scattermeter::apps
