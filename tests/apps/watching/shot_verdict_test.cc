#include "apps/watching/shot_verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/instrument/instrument.h"
#include "apps/simulation/virtual_shots.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A good shot of a cube, of which each test spoils one thing.
class ShotVerdictTest : public ::testing::Test {
 protected:
  ShotVerdictTest()
      : rig_(body_rig("cube", 2)),
        objects_(bodies_scenes(rig_)),
        shots_(rig_, objects_, VirtualShotOptions{.noise = true}),
        instrument_(rig_, objects_, {}),
        look_(instrument_.look(capture::shots_from(
            rig_.scene, {0}, capture::FrameSource([this](std::size_t i, std::size_t k) {
              return shots_.frame(i, 1, k);
            })))) {}

  ShotVerdict verdict() const {
    return judge({look_, 4000.0, rig_.scene.camera.intrinsics.fx_px, "earlier.dng", 0.1});
  }
  ChannelObservation& green() { return look_.shots.front().observation.channel[1]; }

  Rig rig_;
  ObjectScenes objects_;
  VirtualShots shots_;
  Instrument instrument_;
  FirstLook look_;
};

TEST_F(ShotVerdictTest, AGoodShotIsAcceptedWithItsFigures) {
  const ShotVerdict good = verdict();
  EXPECT_THAT(good.problems, IsEmpty());
  ASSERT_EQ(good.remarks.size(), 3U);
  EXPECT_THAT(good.remarks[0], HasSubstr("% of the range"));
  EXPECT_THAT(good.remarks[1], HasSubstr("outline 0."));
  EXPECT_THAT(good.remarks[2], HasSubstr("edges"));
}

TEST_F(ShotVerdictTest, ExposureIsAdvised) {
  look_.shots.front().exposure_s = 0.1;
  green().samples_clipped = green().samples / 20;
  EXPECT_THAT(verdict().problems,
              ElementsAre("overexposed: 5 % of G's samples are clipped; take it at 1/20 s"));
  green().samples_clipped = 0;
  green().brightest_snr = 12.0;
  for (ChannelObservation& o : look_.shots.front().observation.channel) o.brightest_counts = 300.0;
  EXPECT_THAT(verdict().problems,
              ElementsAre("too dark: G's brightest patch is 12 times its noise; check that the LED "
                          "was on, or take it at 1 s"));
  green().brightest_snr = 100.0;
  EXPECT_THAT(verdict().remarks[0], "brightest patch at 8 % of the range (R); less noise at 1 s");
}

TEST_F(ShotVerdictTest, BlurIsAFault) {
  look_.shots.front().edge_blur = EdgeBlur{true, 4.0 * Eigen::Matrix2d::Identity()};
  EXPECT_THAT(verdict().problems, ElementsAre(HasSubstr("out of focus, or moved")));
}

// One cause, in one sentence.
TEST_F(ShotVerdictTest, AMovedOutlineIsComparedWithTheShotBefore) {
  look_.outline->agrees = false;
  look_.outline->shift_px = {3.0, 4.0};
  look_.findings = {{"mesh displaced", "mesh displaced by 1 mm", "put it back", {0}}};
  EXPECT_THAT(verdict().problems,
              ElementsAre(HasSubstr("camera or piece moved: the outline is 5.0 px off, in "
                                    "earlier.dng it was 0.1 px")));
  look_.outline->agrees = true;
  EXPECT_THAT(verdict().problems, ElementsAre("mesh displaced by 1 mm; put it back"));
}

TEST_F(ShotVerdictTest, AnotherLightIsNamed) {
  ShotLikeness& likeness = look_.likeness.front();
  likeness = {0.3, 0.2, "lit by led2", {"led2"}};
  EXPECT_THAT(verdict().seen_lights, IsEmpty());
  likeness.best_other = 0.02;
  EXPECT_THAT(verdict().seen_lights, ElementsAre("led2"));
  EXPECT_THAT(verdict().problems,
              ElementsAre(HasSubstr("the image looks lit by led2, not lit by")));
}

}  // namespace
}  // namespace scattermeter::apps
