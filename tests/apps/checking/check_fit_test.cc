#include "apps/checking/check_fit.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/checking/checked_rig.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::ElementsAre;

// Two shots of PE and one that was in the dark, all of the cube; led2 is a tenth brighter than the
// rig says.
class CheckFitTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    SmallRig files;
    files.keep_shots("_cube_");
    const std::string pom = "POM_cube_1.dng, object: cube, material: POM, lights: [led1]";
    files.write(replaced(files.text(), "{file: " + pom,
                         "{file: dark.dng, object: cube, material: PE, exposure_s: 1.0e-7, "
                         "lights: [led1]"));
    std::string kept;
    std::istringstream lines(files.text());
    for (std::string line; std::getline(lines, line);) {
      const bool other =
          line.find("PP_") != std::string::npos || line.find("POM_") != std::string::npos;
      if (!other) kept += line + "\n";
    }
    files.write(kept);
    const std::string led2 = "axis: [70, 20, -50], exponent: 1, intensity_W_per_sr: ";
    files.write(replaced(kept, led2 + "[0.05, 0.05, 0.05]", led2 + "[0.055, 0.055, 0.055]"));
    files.simulate();
    files.write(kept);
    rig_ = new Rig(read_rig(files.rig()));
    checked_ = new CheckedRig(open_checked_rig(*rig_, files.shots(), {}));
  }
  static void TearDownTestSuite() {
    delete checked_;
    delete rig_;
  }
  static Rig* rig_;
  static CheckedRig* checked_;
};
Rig* CheckFitTest::rig_ = nullptr;
CheckedRig* CheckFitTest::checked_ = nullptr;

TEST_F(CheckFitTest, AFitForEachChannelOfShotsOfUse) {
  const std::vector<CheckedChannel>& channels = checked_->fit.channels;
  ASSERT_EQ(channels.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(channels[c].material, "PE");
    EXPECT_EQ(channels[c].channel, c);
    EXPECT_THAT(channels[c].shots, ElementsAre(0, 1));  // not the dark one
    ASSERT_TRUE(channels[c].departures.has_value());
    EXPECT_EQ(channels[c].departures->power_relative.size(), 2U);
    EXPECT_EQ(channels[c].departures->nuisances.size(), channels[c].nuisances.size());
    ASSERT_EQ(channels[c].singles.size(), 2U);
    EXPECT_EQ(channels[c].singles[1].file, "PE_cube_2.dng");
  }
}

// A tenth between two shots is 4.8 % up and down from their mean: 1.1 / 1 = (1 + x) / (1 - x). Some
// of it may be taken for positions and lobes of the LEDs, for edges or for shifted pictures, as far
// as its deviations tell.
TEST_F(CheckFitTest, SeesThePowerOfAShot) {
  for (const CheckedChannel& fitted : checked_->fit.channels) {
    const std::vector<Departure>& power = fitted.departures->power_relative;
    EXPECT_NEAR(power[1].value - power[0].value, 2.0 * 0.1 / 2.1,
                3.0 * std::hypot(power[0].std, power[1].std));
    EXPECT_GT(power[1].value - power[0].value, 0.05);
    EXPECT_LT(power[1].std, 0.02);
    EXPECT_NEAR(fitted.departures->even_relative[0].value, 0.0, 0.02);
    EXPECT_LT(fitted.departures->residual_relative[0], 0.05);
  }
}

TEST_F(CheckFitTest, EachShotIsLikestToItself) {
  const std::vector<ShotLikeness>& likeness = checked_->fit.likeness;
  ASSERT_EQ(likeness.size(), 3U);
  for (const std::size_t i : {0U, 1U}) {
    EXPECT_LT(likeness[i].own, 0.1);
    // Its own lights explain it, so no others are tried.
    EXPECT_TRUE(std::isinf(likeness[i].best_other));
    EXPECT_EQ(likeness[i].other, "");
  }
  EXPECT_TRUE(std::isnan(likeness[2].own));
}

}  // namespace
}  // namespace scattermeter::apps
