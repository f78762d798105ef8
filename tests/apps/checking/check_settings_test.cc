#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

// The camera wrote it down.
TEST(CheckSettings, ApertureAndIsoChanged) {
  SmallRig rig;
  rig.keep_shots("POM_cube");
  rig.simulate();
  reshoot(rig, "POM_cube_2", "  exposure_s: 0.05\n",
          "  exposure_s: 0.05\n  f_number: 5.6\n  iso: 200\n");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("aperture"), "fail");
  EXPECT_EQ(c.verdict("ISO setting"), "fail");
}

// Against what most shots have, in percent.
TEST(CheckSettings, AgainstTheUsualOne) {
  MadeCheckedRig made(4);
  made.checked.shots[2].f_number = 5.6;
  made.checked.shots[0].iso = 101;
  std::vector<CheckItem> items = check_settings(made.checked);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].what, "aperture");
  EXPECT_FALSE(items[0].passed);
  EXPECT_EQ(items[0].where, "c.dng");
  EXPECT_NEAR(items[0].worst, -30.0, 1e-9);
  EXPECT_NEAR(items[0].rms, 15.0, 1e-9);
  EXPECT_EQ(items[1].what, "ISO setting");
  EXPECT_FALSE(items[1].passed);
  EXPECT_EQ(items[1].where, "a.dng");
  EXPECT_NEAR(items[1].worst, 1.0, 1e-9);
  // As files round them.
  made.checked.shots[0].iso = 100.4;
  EXPECT_TRUE(check_settings(made.checked)[1].passed);
}

// A lens without contacts: no file says an aperture. One that does is of another lens.
TEST(CheckSettings, NotInTheFiles) {
  MadeCheckedRig made(3);
  for (ObservedShot& shot : made.checked.shots) shot.f_number = 0;
  EXPECT_TRUE(check_settings(made.checked)[0].passed);
  made.checked.shots[1].f_number = 8;
  EXPECT_FALSE(check_settings(made.checked)[0].passed);
}

}  // namespace
}  // namespace scattermeter::apps
