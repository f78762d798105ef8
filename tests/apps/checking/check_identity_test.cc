#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckIdentity, LightsExchanged) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  exchange(rig, "PE_cube_1.dng", "PE_cube_2.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("light in shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light in shot"), HasSubstr("PE_cube_"));
  EXPECT_THAT(c.where("light in shot"), HasSubstr("lit by led"));
}

TEST(CheckIdentity, ObjectsExchanged) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  exchange(rig, "PE_cube_1.dng", "PE_pyramid_1.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("light in shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light in shot"), HasSubstr("of object"));
}

TEST(CheckIdentity, MaterialsExchanged) {
  SmallRig rig;
  rig.keep_shots("_cube_");
  rig.simulate();
  exchange(rig, "PP_cube_1.dng", "POM_cube_1.dng");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("material in shot"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("material in shot"), "PP_cube_1.dng and POM_cube_1.dng");
}

}  // namespace
}  // namespace scattermeter::apps
