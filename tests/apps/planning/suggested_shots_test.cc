#include "apps/planning/suggested_shots.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/pages/plan_page.h"
#include "apps/planning/plan.h"
#include "tests/fixtures/apps/body_rig.h"
#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// More shots and better known quantities never tell less; the coarse forecast is no other one.
TEST(SuggestedShots, Help) {
  Rig rig = body_rig("cube", 1);
  rig.scene.camera.responsivity_relative_std = 0.02;
  // A mean free path longer than the patches of 1.8 mm keeps the errors of the method small: they
  // are not fitted, and another shot may weigh them otherwise.
  rig.truth.materials["plastic"].fill({0.5, 0.004, 1.0});
  const ObjectScenes scenes = bodies_scenes(rig);
  PlanOptions options;

  const Plan made = plan(rig, scenes, options);
  ASSERT_EQ(made.suggested_shots.size(), 1U);
  const SuggestedShots& other = made.suggested_shots[0];
  EXPECT_GT(other.coarse_ratio, 0.6);
  EXPECT_LT(other.coarse_ratio, 1.7);
  EXPECT_GE(other.gains.size(), 4U);
  for (std::size_t i = 0; i < other.gains.size(); ++i) {
    EXPECT_LT(other.gains[i].sigma_a_ratio, 1.001) << other.gains[i].what;
    EXPECT_GT(other.gains[i].sigma_a_ratio, 0.0) << other.gains[i].what;
    if (i == 0) continue;
    EXPECT_GE(other.gains[i].sigma_a_ratio, other.gains[i - 1].sigma_a_ratio);
  }
  ASSERT_EQ(other.maps.size(), 1U);
  const LedMap& map = other.maps[0];
  std::size_t answers = 0;
  for (const LedPosition& at : map.positions) {
    EXPECT_NEAR((at.position_mm - map.center_mm).norm(), map.distance_mm, 1e-9);
    if (!std::isfinite(at.joined)) continue;
    ++answers;
    EXPECT_LT(at.joined, 1.02 * other.planned);
    if (!std::isfinite(at.alone)) continue;
    EXPECT_LT(at.joined, 1.02 * at.alone);
  }
  EXPECT_GT(answers, 60U);
  EXPECT_EQ(html_problem(plan_page(made, "<mark>")), "");
  EXPECT_THAT(plan_page(made, "<mark>"), ::testing::Not(HasSubstr("<mark>")));
}

}  // namespace
}  // namespace scattermeter::apps
