#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/checked_small_rig.h"
#include "tests/fixtures/apps/made_checked_rig.h"

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

TEST(CheckLight, DeparturesByHand) {
  MadeCheckedRig made(3);
  CheckedChannel& fitted = made.add_channel(1, {0, 1, 2});
  fitted.departures->power_relative[1] = {0.06, 0.01};
  fitted.departures->even_relative[2] = {-0.03, 0.002};
  fitted.departures->residual_relative[0] = 0.11;
  std::vector<CheckItem> items = check_light(made.checked);
  ASSERT_EQ(items.size(), 5U);
  EXPECT_EQ(items[0].what, "image residual");
  EXPECT_FALSE(items[0].passed);
  EXPECT_NEAR(items[0].worst, 11.0, 1e-12);
  EXPECT_EQ(items[0].where, "a.dng G");
  EXPECT_EQ(items[1].what, "light of shot");
  EXPECT_FALSE(items[1].passed);
  EXPECT_NEAR(items[1].worst, 6.0, 1e-12);
  EXPECT_NEAR(items[1].details[1].std, 1.0, 1e-12);
  EXPECT_EQ(items[1].where, "b.dng G");
  EXPECT_EQ(items[3].what, "light from elsewhere");
  EXPECT_FALSE(items[3].passed);
  EXPECT_NEAR(items[3].worst, -3.0, 1e-12);
  EXPECT_EQ(items[3].where, "c.dng G");
  // Within five deviations.
  fitted.departures->power_relative[1].std = 0.013;
  fitted.departures->even_relative[2].std = 0.007;
  items = check_light(made.checked);
  EXPECT_TRUE(items[1].passed);
  EXPECT_TRUE(items[3].passed);
}

// Twice the exposure time that the file states pulls at the scale; the LED's position does not
// count here.
TEST(CheckLight, StrengthOfLight) {
  MadeCheckedRig made(1);
  CheckedChannel& fitted = made.add_channel(1, {0});
  const auto item = [&] { return check_light(made.checked).back(); };
  EXPECT_TRUE(item().passed);
  fitted.estimate.pulls = {{"led1.position0", "LED position", 20.0},
                           {"led1.power", "LED power", 3.0},
                           {"scale", "scale", -3.9}};
  EXPECT_EQ(item().what, "strength of light");
  EXPECT_TRUE(item().passed);
  fitted.estimate.pulls[2].pull = -4.1;
  EXPECT_FALSE(item().passed);
  EXPECT_EQ(item().worst, -4.1);
  EXPECT_THAT(item().where, HasSubstr("G: scale"));
}

// An LED that loses 3 % from shot to shot of five: 12 % over all, to the digit.
TEST(CheckLight, Drift) {
  MadeCheckedRig made(5);
  CheckedChannel& red = made.add_channel(0, {0, 1, 2, 3, 4});
  for (std::size_t i = 0; i < 5; ++i) {
    const double scatter = i % 2 == 0 ? 1e-4 : -1e-4;
    red.departures->power_relative[i] = {-0.03 * static_cast<double>(i) + scatter, 0.001};
  }
  CheckItem item = check_light(made.checked)[2];
  EXPECT_EQ(item.what, "LED drift");
  EXPECT_EQ(item.where, "led1");
  EXPECT_NEAR(item.worst, -12.0, 0.05);
  EXPECT_FALSE(item.passed);
  // Between two materials there is no drift, only their levels.
  for (const std::size_t i : {3U, 4U}) made.rig.scene.shots[i].material = "n";
  for (std::size_t i = 0; i < 5; ++i) {
    const double scatter = i % 2 == 0 ? 1e-4 : -1e-4;
    red.departures->power_relative[i] = {(i < 3 ? 0.0 : -0.12) + scatter, 0.001};
  }
  item = check_light(made.checked)[2];
  EXPECT_NEAR(item.worst, 0.0, 0.1);
  EXPECT_TRUE(item.passed);
}

// A shot alone has nothing to be held against; a material without a joint model neither.
TEST(CheckLight, NothingToHoldAgainst) {
  MadeCheckedRig made(1);
  made.add_channel(0, {0});
  std::vector<CheckItem> items = check_light(made.checked);
  EXPECT_TRUE(items[1].details.empty());
  EXPECT_TRUE(items[2].details.empty());
  EXPECT_EQ(items[3].details.size(), 1U);
  made.checked.fit.channels[0].departures.reset();
  for (const CheckItem& item : check_light(made.checked)) EXPECT_TRUE(item.details.empty());
}

}  // namespace
}  // namespace scattermeter::apps
