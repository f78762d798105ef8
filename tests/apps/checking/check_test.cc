#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(Check, AGoodRigPasses) {
  SmallRig rig;
  rig.keep_shots("POM_");
  rig.simulate();
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 0) << c.answer.out << c.answer.err;
  // Of one material, two things have nothing to be held against.
  for (const auto& [what, item] : c.items) {
    const bool judged = what != "LED drift" && what != "material in shot";
    EXPECT_EQ(item["verdict"], judged ? "pass" : "not judged") << what;
  }
  EXPECT_THAT(c.answer.out, HasSubstr("all "));
  const std::string page = slurp(rig.out() + "/check.html");
  EXPECT_EQ(html_problem(page), "");
  EXPECT_LT(page.size(), 5'000'000U);
  EXPECT_THAT(page, HasSubstr("POM_pyramid_2.dng"));
}

}  // namespace
}  // namespace scattermeter::apps
