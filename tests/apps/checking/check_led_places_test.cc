#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/made_checked_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CheckLedPlaces, AnLedThatMovedByTwoMillimetres) {
  SmallRig rig;
  rig.keep_shots("PE_");
  rig.simulate();
  rig.write(replaced(rig.text(), "position_mm: [30, -60, 80]", "position_mm: [32, -60, 80]"));
  const Checked c = check(rig);
  EXPECT_EQ(c.answer.status, 1);
  EXPECT_EQ(c.verdict("LED place"), "fail") << c.answer.out;
  EXPECT_EQ(c.where("LED place"), "led1 along x");
  EXPECT_NEAR(c.items.at("LED place")["worst"].get<double>(), -2.0, 0.5);
}

TEST(CheckLedPlaces, MeanOverTheChannels) {
  MadeCheckedRig made(2);
  const auto fill = [&](double x_of_red, double x_of_green, double std) {
    made.checked.fit.channels.clear();
    for (const double x : {x_of_red, x_of_green}) {
      CheckedChannel& fitted = made.add_channel(0, {0, 1});
      // Among others, in any order.
      fitted.nuisances.resize(4);
      fitted.nuisances[0].name = "pose.x";
      fitted.nuisances[1].name = "led1.position2";
      fitted.nuisances[2].name = "led1.position0";
      fitted.nuisances[3].name = "led1.position1";
      fitted.departures->nuisances = {{99, 1}, {0.1, std}, {x, std}, {-0.2, std}};
    }
  };
  fill(0.5, 0.7, 0.01);
  CheckItem item = check_led_places(made.checked)[0];
  EXPECT_EQ(item.what, "LED place");
  ASSERT_EQ(item.details.size(), 3U);
  EXPECT_EQ(item.details[0].where, "led1 along x");
  EXPECT_NEAR(item.details[0].value, 0.6, 1e-12);
  EXPECT_NEAR(item.details[1].value, -0.2, 1e-12);
  EXPECT_NEAR(item.details[2].value, 0.1, 1e-12);
  EXPECT_NEAR(item.details[0].std, 0.01, 1e-12);
  EXPECT_FALSE(item.passed);
  EXPECT_EQ(item.where, "led1 along x");
  // The rig itself says that it knows the place to 0.1 mm: three times that are allowed, too.
  made.rig.scene.lights[0].led()->position_std_mm = 0.1;
  item = check_led_places(made.checked)[0];
  EXPECT_NEAR(item.limit, 0.8, 1e-12);
  EXPECT_TRUE(item.passed);
  // Far off, but not known.
  made.rig.scene.lights[0].led()->position_std_mm = 0.0;
  fill(3.0, 3.0, 1.0);
  EXPECT_TRUE(check_led_places(made.checked)[0].passed);
}

TEST(CheckLedPlaces, WithoutALedThereIsNothing) {
  MadeCheckedRig made(1);
  made.add_channel(0, {0});
  made.rig.scene.lights[0].kind = AmbientLight{};
  EXPECT_TRUE(check_led_places(made.checked)[0].details.empty());
}

}  // namespace
}  // namespace scattermeter::apps
