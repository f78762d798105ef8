#include "apps/looks/light_look.h"

#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "apps/instrument/open_shots.h"
#include "apps/simulation/virtual_shots.h"
#include "calib/pose/shot_pose.h"
#include "tests/fixtures/apps/lit_shots.h"

namespace scattermeter::apps {
namespace {

TEST(LightLook, TheListedLightsExplainAGoodShot) {
  LitShots lit("cube");
  LightLook look(lit.rig.scene, *lit.lit, lit.shots, lit.weights);
  for (std::size_t i = 0; i < 2; ++i) {
    const ShotLikeness like = look.likeness(i);
    EXPECT_LT(like.own, 0.05);
    // No other is tried where there is no doubt.
    EXPECT_TRUE(std::isinf(like.best_other));
  }
}

TEST(LightLook, OtherLightsExplainAnExchangedShot) {
  LitShots lit("cube");
  std::swap(lit.shots[0].observation, lit.shots[1].observation);
  LightLook look(lit.rig.scene, *lit.lit, lit.shots, lit.weights);
  const ShotLikeness like = look.likeness(0);
  EXPECT_GT(like.own, 0.2);
  EXPECT_LT(like.best_other, 0.05);
  EXPECT_EQ(like.other, "lit by led2");
  EXPECT_EQ(like.other_lights, std::vector<std::string>{"led2"});
}

// No shot is listed as lit by the LED that lit this one.
TEST(LightLook, AnLedThatNoShotListsExplainsAShot) {
  LitShots lit("cube");
  lit.rig.scene.shots[1].lights = {"led1"};
  LightLook look(lit.rig.scene, *lit.lit, lit.shots, lit.weights);
  EXPECT_EQ(look.likeness(1).other_lights, std::vector<std::string>{"led2"});
  const std::vector<Finding> findings = look.findings();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].cause, "file exchanged");
}

// Shot 0 is listed as lit by one of the LEDs that lit it.
TEST(LightLook, AnotherLedWasOnToo) {
  LitShots lit("cube");
  for (std::size_t c = 0; c < kRgb; ++c) {
    ChannelObservation& first = lit.shots[0].observation.channel[c];
    const ChannelObservation& second = lit.shots[1].observation.channel[c];
    for (std::size_t row = 0; row < first.l.size(); ++row) first.l[row] += second.l[row];
  }
  LightLook look(lit.rig.scene, *lit.lit, lit.shots, lit.weights);
  const std::vector<Finding> findings = look.findings();
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].cause, "another LED on");
  EXPECT_EQ(findings[0].shots, std::vector<std::size_t>{0});
  EXPECT_NE(findings[0].text.find("looks lit by led1 and led2, not by led1 alone"),
            std::string::npos)
      << findings[0].text;
}

// A spare LED that faces away is no candidate, and no error.
TEST(LightLook, AnLedThatReachesNothingIsNotTried) {
  LitShots lit("cube");
  SceneLight spare = lit.rig.scene.lights[0];
  spare.name = "spare";
  spare.led()->led.axis *= -1.0;
  lit.rig.scene.lights.push_back(spare);
  std::swap(lit.shots[0].observation, lit.shots[1].observation);
  LightLook look(lit.rig.scene, *lit.lit, lit.shots, lit.weights);
  EXPECT_EQ(look.likeness(0).other, "lit by led2");
}

TEST(LightLook, AnotherView) {
  LitShots lit("cube");
  LightLook look(lit.rig.scene, *lit.lit, lit.shots, lit.weights);
  ShotLikeness like;
  look.compare_object(*lit.shots[0].seen, lit.shots[1].observation, 1, like);
  EXPECT_LT(like.best_other, 0.05);
  EXPECT_EQ(like.other, "of object cube, lit by led2");
}

}  // namespace
}  // namespace scattermeter::apps
