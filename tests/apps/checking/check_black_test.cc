#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckBlack, TheDarkestBackground) {
  MadeCheckedRig made(3);
  EXPECT_TRUE(check_black(made.checked)[0].details.empty());  // the objects fill the frames
  for (std::size_t i = 0; i < 3; ++i) {
    CheckedFrame& frame = made.checked.frames[i];
    frame.black_counts.fill(64.0);
    frame.background.blocks = 100;
    frame.background.darkest_counts.fill(2.0);
    frame.background.block_std_counts.fill(0.1);
    for (ChannelObservation& o : made.checked.shots[i].observation.channel) {
      o.brightest_counts = 1000.0;
    }
  }
  std::vector<CheckItem> items = check_black(made.checked);
  ASSERT_EQ(items.size(), 2U);
  EXPECT_EQ(items[0].what, "background");
  EXPECT_EQ(items[0].details.size(), 9U);
  EXPECT_NEAR(items[0].worst, 0.2, 1e-12);  // 2 of 1000 counts
  EXPECT_NEAR(items[0].details[0].std, 0.01, 1e-12);
  EXPECT_EQ(items[1].what, "black drift");
  EXPECT_NEAR(items[1].worst, 0.0, 1e-12);
  EXPECT_EQ(items[1].limit, 1.0);  // half a read noise of 2 counts
  // A lamp in one shot: both see it.
  made.checked.frames[1].background.darkest_counts[2] = 14.0;
  items = check_black(made.checked);
  EXPECT_FALSE(items[0].passed);
  EXPECT_NEAR(items[0].worst, 1.4, 1e-12);
  EXPECT_EQ(items[0].where, "b.dng B");
  EXPECT_FALSE(items[1].passed);
  EXPECT_NEAR(items[1].worst, 12.0, 1e-12);
  EXPECT_EQ(items[1].where, "b.dng B");
  // The file's own black has moved along: no drift.
  made.checked.frames[1].background.darkest_counts[2] = -10.0;
  made.checked.frames[1].black_counts.fill(76.0);
  made.checked.frames[1].background.darkest_counts[0] = -10.0;
  made.checked.frames[1].background.darkest_counts[1] = -10.0;
  EXPECT_TRUE(check_black(made.checked)[1].passed);
  // So little as the blocks scatter is nothing.
  made.checked.frames[1].background.block_std_counts.fill(10.0);
  made.checked.frames[1].background.darkest_counts.fill(2.0);
  EXPECT_TRUE(check_black(made.checked)[1].passed);
}

}  // namespace
}  // namespace scattermeter::apps
