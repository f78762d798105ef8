#include "apps/looks/first_look.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/core/cube_estimation.h"

namespace scattermeter::apps {
namespace {

Finding finding(const std::string& cause, std::vector<std::size_t> shots) {
  return {cause, cause + " seen", "mend it", std::move(shots)};
}

TEST(FirstLook, LightOfAWrongOutlineIsItsConsequence) {
  const std::vector<Finding> all =
      in_order({finding("mesh displaced", {0, 1})},
               {finding("image not explained", {1}), finding("object covered", {2}),
                finding("LEDs exchanged", {0, 1}), finding("unit: mW for W", {0, 1})});
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[0].cause, "mesh displaced");
  EXPECT_EQ(all[1].cause, "object covered");
  EXPECT_EQ(all[2].cause, "LEDs exchanged");
  EXPECT_EQ(all[3].cause, "unit: mW for W");
  EXPECT_EQ(all[0].sentence(), "mesh displaced seen; mend it");
}

// The most probable two, and only of the channels whose shots they concern.
TEST(FirstLook, RefusesItsChannels) {
  test_support::DipoleCube cube(2);
  cube.show({1.0, 0.01, 1.0});
  test_support::CubeEstimation e(cube, "G");
  refuse(cube.scene, {finding("unit", {7})}, e.estimation);
  EXPECT_TRUE(e.estimation.results.at(0).estimate.reasons.empty());
  refuse(cube.scene, {finding("a", {1}), finding("b", {0, 1}), finding("c", {0})}, e.estimation);
  const std::vector<std::string>& reasons = e.estimation.results.at(0).estimate.reasons;
  ASSERT_EQ(reasons.size(), 2U);
  EXPECT_EQ(reasons[0], "a seen; mend it");
}

// An outline that is off explains what the fit refused, and nothing else.
TEST(FirstLook, OutlineIsTheFirstReasonOfWhatWasFitted) {
  std::vector<ChannelResult> results(3);
  results[0].estimate.rows = 100;
  results[0].estimate.reasons = {"misfit"};
  results[1].estimate.rows = 100;
  results[2].estimate.reasons = {"dark"};
  tell_of_outline("", results);
  EXPECT_EQ(results[0].estimate.reasons.size(), 1U);
  tell_of_outline("the outlines stand 2.0 px low", results);
  ASSERT_EQ(results[0].estimate.reasons.size(), 2U);
  EXPECT_THAT(results[0].estimate.reasons[0], testing::HasSubstr("stand 2.0 px low"));
  EXPECT_TRUE(results[1].estimate.reasons.empty());
  EXPECT_EQ(results[2].estimate.reasons.size(), 1U);
}

// A bright background explains what the fit refused of its own shots.
TEST(FirstLook, ABrightBackgroundIsTheFirstReason) {
  SceneShot bright_stated, dark_stated;
  bright_stated.file = "bright.dng";
  dark_stated.file = "dark.dng";
  std::vector<ObservedShot> shots(2);
  shots[0].stated = &bright_stated;
  shots[1].stated = &dark_stated;
  for (ObservedShot& shot : shots) {
    shot.exposures.resize(1);
    for (ChannelObservation& o : shot.observation.channel) o.brightest_counts = 1000.0;
  }
  shots[0].exposures[0].pedestal_counts[1] = 100.0;  // half of the background
  shots[1].exposures[0].pedestal_counts[1] = 20.0;
  std::vector<ChannelResult> results(4);
  for (ChannelResult& r : results) {
    r.channel = 'G';
    r.shots = {"dark.dng", "bright.dng"};
    r.estimate.rows = 100;
    r.estimate.reasons = {"misfit"};
  }
  results[1].channel = 'R';
  results[2].shots = {"dark.dng"};
  results[3].estimate.reasons.clear();
  tell_of_background(shots, results);
  ASSERT_EQ(results[0].estimate.reasons.size(), 2U);
  EXPECT_THAT(results[0].estimate.reasons[0],
              testing::HasSubstr("as bright in bright.dng as 20 % of the brightest patch (200 "
                                 "counts above black)"));
  EXPECT_EQ(results[1].estimate.reasons.size(), 1U);
  EXPECT_EQ(results[2].estimate.reasons.size(), 1U);
  EXPECT_TRUE(results[3].estimate.reasons.empty());
}

}  // namespace
}  // namespace scattermeter::apps
