#include "apps/pages/plan_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/made_plan.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PlanPage, HoldsThePlansNumbers) {
  const std::string page = plan_page(made_plan(), "scattermeter plan <rig>");
  EXPECT_EQ(html_problem(page), "");
  for (const char* text :
       {"1 of 2 values would be refused.", "scattermeter plan &lt;rig&gt; (1.5 s",
        "POM G at 2 / 0.01 per mm would be refused: a.dng: channel G is dark.",
        "1 of 2 need another exposure time.", "3000 of 4031", "25 % of the object is clipped",
        "0.01, 0.04",
        "Channel R has the least certain sigma_a: the planned shots determine it to 50 %.",
        "one more shot", "scale known exactly", "value=\"0.6400\">64 %<", "value=\"0.3600\">36 %<",
        "data-widget=\"plot\"", "Best: 40 % with the LED at (0, 0, 110) mm",
        "The materials are the rig&#39;s truth.materials."}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
  // A gain of half a per cent is none.
  EXPECT_THAT(page, Not(HasSubstr("twice the light")));
  EXPECT_THAT(page, Not(HasSubstr("refused corners")));
}

TEST(PlanPage, ARangeHasItsCorners) {
  Plan plan = made_plan();
  plan.suggested_shots.clear();
  Forecast corner = plan.channels[0].expected;
  corner.estimate.sigma_a_per_mm = normal_quantity(0.01, 0.0098);
  corner.estimate.reasons = {"too dark"};
  for (PlannedChannel& c : plan.channels) c.corners = {corner};
  plan.brightness_known = false;
  const std::string page = plan_page(plan, "");
  EXPECT_EQ(html_problem(page), "");
  EXPECT_THAT(page, HasSubstr("refused corners"));
  EXPECT_THAT(page, HasSubstr("50 … 98 %"));
  EXPECT_THAT(page, HasSubstr("The brightness of the shots cannot be predicted"));
  EXPECT_THAT(page, Not(HasSubstr("Where to put an LED")));
}

TEST(PlanPage, NothingIsMeasured) {
  Plan plan = made_plan();
  plan.channels.erase(plan.channels.begin());
  EXPECT_THAT(plan_page(plan, ""), HasSubstr("No channel of it would be measured."));
}

}  // namespace
}  // namespace scattermeter::apps
