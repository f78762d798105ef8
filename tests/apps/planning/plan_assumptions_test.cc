#include "apps/planning/plan_assumptions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_plan.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(PlanAssumptions, OnlyThoseThatHold) {
  Plan plan = made_plan();
  plan.suggested_shots.clear();
  std::vector<std::string> said = plan_assumptions(plan);
  ASSERT_EQ(said.size(), 4U);
  EXPECT_THAT(said[0], HasSubstr("truth.materials"));
  EXPECT_THAT(said[1], HasSubstr("camera.sensor: 6 electrons a count and 1.25 counts read noise"));
  plan = made_plan();
  plan.from_truth = false;
  plan.calibrated_noise = true;
  plan.brightness_known = false;
  plan.neutral_camera = true;
  said = plan_assumptions(plan);
  ASSERT_EQ(said.size(), 7U);
  EXPECT_THAT(said[0], HasSubstr("corners of the range"));
  EXPECT_THAT(said[1], HasSubstr("camera.radiance"));
  EXPECT_THAT(said[4], HasSubstr("no responsivity"));
  EXPECT_THAT(said[5], HasSubstr("no truth.sensor"));
}

}  // namespace
}  // namespace scattermeter::apps
