#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckNoise, SamplesAgainstTheModel) {
  MadeCheckedRig made(2);
  EXPECT_TRUE(check_noise(made.checked)[0].passed);  // nothing to judge
  // mean, variance, relative deviation of a variance, the model's, triples.
  made.checked.frames[0].noise[1] = {{100, 12.0, 0.01, 10.0, 300}, {400, 30.0, 0.02, 20.0, 100}};
  CheckItem item = check_noise(made.checked)[0];
  EXPECT_EQ(item.what, "noise");
  ASSERT_EQ(item.details.size(), 1U);
  // 300 x 12 + 100 x 30 of 300 x 10 + 100 x 20.
  EXPECT_NEAR(item.worst, 100.0 * (6600.0 / 5000.0 - 1.0), 1e-9);
  EXPECT_EQ(item.where, "a.dng G");
  EXPECT_NEAR(item.details[0].std, 100.0 * std::hypot(30.0, 40.0) / 5000.0, 1e-9);
  EXPECT_FALSE(item.passed);  // 32 % above, with 1 % by chance
  // Less noise than the model passes, but is told; and what may be chance passes.
  EXPECT_EQ(quiet_note(made.checked), "");
  made.checked.frames[0].noise[1] = {{100, 1.0, 0.01, 10.0, 300}};
  EXPECT_TRUE(check_noise(made.checked)[0].passed);
  EXPECT_THAT(quiet_note(made.checked), HasSubstr("a.dng G the least (0.1 of the variance)"));
  made.checked.frames[0].noise[1] = {{100, 3.0, 0.01, 10.0, 300}};
  EXPECT_EQ(quiet_note(made.checked), "");
  made.checked.frames[0].noise[1] = {{100, 1.0, 0.2, 10.0, 300}};
  EXPECT_EQ(quiet_note(made.checked), "");
  made.checked.frames[0].noise[1] = {{100, 15.0, 0.1, 10.0, 300}};
  EXPECT_TRUE(check_noise(made.checked)[0].passed);
  made.checked.frames[0].noise[1] = {{100, 17.0, 0.1, 10.0, 300}};
  EXPECT_FALSE(check_noise(made.checked)[0].passed);
  // Chance is that of the model's noise, not of the larger one that is seen.
  made.checked.frames[0].noise[1] = {{100, 30.0, 0.2, 10.0, 300}};
  EXPECT_FALSE(check_noise(made.checked)[0].passed);
}

}  // namespace
}  // namespace scattermeter::apps
