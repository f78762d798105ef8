#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/made_checked_rig.h"

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

TEST(CheckExposure, ByHand) {
  MadeCheckedRig made(2);
  for (ObservedShot& shot : made.checked.shots) {
    for (ChannelObservation& o : shot.observation.channel) {
      o.l = {1.0, 1.0};
      o.samples = 200;
      o.brightest_snr = 100.0;
    }
  }
  made.checked.shots[0].observation.channel[1].samples_clipped = 2;  // 1 %, the limit
  std::vector<CheckItem> items = check_exposure(made.checked);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].what, "clipped");
  EXPECT_TRUE(items[0].passed);
  EXPECT_EQ(items[0].worst, 1.0);
  EXPECT_EQ(items[0].where, "a.dng G");
  EXPECT_TRUE(items[1].passed);
  made.checked.shots[0].observation.channel[1].samples_clipped = 3;
  made.checked.shots[1].observation.channel[2].brightest_snr = 29.9;
  items = check_exposure(made.checked);
  EXPECT_FALSE(items[0].passed);
  EXPECT_EQ(items[1].what, "brightest patch");
  EXPECT_FALSE(items[1].passed);
  EXPECT_EQ(items[1].where, "b.dng B");
  EXPECT_TRUE(items[1].at_least);
  // What is clipped altogether is not to be exposed longer.
  made.checked.shots[1].observation.channel[2].brightest_snr = 100.0;
  made.checked.shots[1].observation.channel[0].rows_clipped = 2;
  made.checked.shots[1].observation.channel[0].samples_clipped = 200;
  made.checked.shots[1].observation.channel[0].brightest_snr = 0.0;
  items = check_exposure(made.checked);
  EXPECT_FALSE(items[0].passed);
  EXPECT_EQ(items[0].where, "b.dng R");
  EXPECT_TRUE(items[1].passed);
}

}  // namespace
}  // namespace scattermeter::apps
