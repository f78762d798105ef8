#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckLight, ALightLeftOn) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  // In one shot.
  const std::string before = rig.text();
  rig.write(replaced(before, "lights:\n  led1:",
                     "lights:\n  lamp: {type: ambient, radiance_W_per_mm2_sr: [1.5e-7, 1.5e-7, "
                     "1.5e-7], radiance_std_W_per_mm2_sr: [0, 0, 0]}\n  led1:"));
  reshoot(rig, "PE_cube_2", "cube, material: PE, lights: [led2]",
          "cube, material: PE, lights: [led2, lamp]");
  rig.write(before);
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1) << c.answer.out;
  EXPECT_EQ(c.verdict("light from elsewhere"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light from elsewhere"), HasSubstr("PE_cube_2.dng"));
}

// A lens without contacts: only the light tells. A third of a stop.
TEST(CheckLight, ApertureChangedUnseen) {
  SmallRig rig;
  rig.keep_shots("POM_");
  rig.simulate();
  reshoot(rig, "POM_pyramid_1", "[2.4e10, 2.9e10, 2.1e10]", "[1.9e10, 2.3e10, 1.67e10]");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("aperture"), "pass");
  EXPECT_EQ(c.verdict("light of shot"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("light of shot"), HasSubstr("POM_pyramid_1.dng"));
}

}  // namespace
}  // namespace scattermeter::apps
