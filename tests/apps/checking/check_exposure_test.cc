#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckExposure, OneClippedChannel) {
  SmallRig rig;
  rig.keep_shots("POM_cube");
  rig.simulate();
  reshoot(rig, "POM_cube_1",
          "axis: [-30, 60, -70], exponent: 1, intensity_W_per_sr: [0.05, 0.05, 0.05]",
          "axis: [-30, 60, -70], exponent: 1, intensity_W_per_sr: [0.05, 0.15, 0.05]");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("clipped"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("clipped"), "POM_cube_1.dng G");
  EXPECT_THAT(c.answer.out, HasSubstr("expose shorter"));
}

TEST(CheckExposure, AnLedThatWasOff) {
  SmallRig rig;
  rig.keep_shots("PP_");
  rig.simulate();
  reshoot(rig, "PP_pyramid_2",
          "axis: [70, 20, -50], exponent: 1, intensity_W_per_sr: [0.05, 0.05, 0.05]",
          "axis: [70, 20, -50], exponent: 1, intensity_W_per_sr: [1e-9, 1e-9, 1e-9]");
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("brightest patch"), "fail") << c.answer.out;
  EXPECT_THAT(c.where("brightest patch"), HasSubstr("PP_pyramid_2.dng"));
  EXPECT_THAT(c.answer.out, HasSubstr("whether the LED was on"));
  // The others are judged all the same.
  EXPECT_EQ(c.verdict("light of shot"), "pass");
}

}  // namespace
}  // namespace scattermeter::apps
