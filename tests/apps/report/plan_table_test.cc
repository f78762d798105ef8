#include "apps/report/plan_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_plan.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(PlanTable, IsThisText) {
  EXPECT_EQ(
      plan_table(made_plan()),
      "material  ch  sigma_s' [1/mm]  known to  sigma_a [1/mm]  known to  sigma_a's variance by   "
      "verdict\n"
      "POM       R                 2       5 %            0.01      50 %  scale 64 %, noise 36 %  "
      "ok\n"
      "          G                 2         –            0.01         –                          "
      "refused\n"
      "refused: POM G: a.dng: channel G is dark\n"
      "exposure: a.dng G: 25 % of the object is clipped\n"
      "POM R: sigma_a will be known to 50 %; this would improve to\n"
      "     30 %  with scale known exactly\n"
      "     30 %  with one more shot\n"
      "     50 %  with twice the light\n");
}

TEST(PlanTable, ExposuresInOneLine) {
  Plan plan = made_plan();
  plan.exposures[1].advice.clear();
  EXPECT_THAT(plan_table(plan), HasSubstr("exposure: nothing clips, nothing is too dark\n"));
  plan.brightness_known = false;
  EXPECT_THAT(plan_table(plan), HasSubstr("exposure: unknown without camera.responsivity"));
}

TEST(PlanTable, Corners) {
  Plan plan = made_plan();
  Forecast corner = plan.channels[0].expected;
  corner.medium.sigma_a_per_mm = 0.002;
  corner.estimate.sigma_a_per_mm = normal_quantity(0.002, 0.002);
  corner.estimate.reasons = {"the error is larger than the value"};
  plan.channels[0].corners = {corner};
  EXPECT_THAT(plan_table(plan), HasSubstr("50 … 100 %"));
  EXPECT_THAT(plan_table(plan),
              HasSubstr("refused: POM R at 2 / 0.002 per mm: the error is larger than the value"));
}

}  // namespace
}  // namespace scattermeter::apps
