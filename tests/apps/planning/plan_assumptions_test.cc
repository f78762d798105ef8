#include "apps/planning/plan_assumptions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(PlanAssumptions, StateTheNoise) {
  Plan plan;
  plan.noise[1] = {6.25, 1.5};
  EXPECT_THAT(plan_assumptions(plan),
              Contains(HasSubstr("camera.sensor: 6.25 electrons per count")));
  plan.calibrated_noise = true;
  EXPECT_THAT(plan_assumptions(plan),
              Contains(HasSubstr("camera.radiance: 6.25 electrons per count")));
}

// Each condition adds a sentence of its own, and only that.
TEST(PlanAssumptions, DependOnThePlan) {
  const std::vector<std::string> least = plan_assumptions({});
  EXPECT_THAT(least, Not(Contains(HasSubstr("no responsivity"))));
  Plan plan;
  plan.brightness_known = false;
  plan.neutral_camera = true;
  plan.suggested_shots.emplace_back();
  const std::vector<std::string> all = plan_assumptions(plan);
  EXPECT_EQ(all.size(), least.size() + 3);
  EXPECT_THAT(all, Contains(HasSubstr("no responsivity")));
  EXPECT_THAT(all, Contains(HasSubstr("no truth.sensor")));
  EXPECT_THAT(all, Contains(HasSubstr("coarse patches")));
  plan.from_truth = false;
  EXPECT_THAT(all, Contains(HasSubstr("the rig's truth.materials")));
  EXPECT_THAT(plan_assumptions(plan), Contains(HasSubstr("corners of the given range")));
}

}  // namespace
}  // namespace scattermeter::apps
