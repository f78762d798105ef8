#include "apps/rig/rig_sensor_truth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

capture::SensorTruth sensor_truth_of(const std::string& text) {
  return read_sensor_truth(yaml_text(text));
}

TEST(RigSensorTruth, ReadsEveryField) {
  const capture::SensorTruth truth = sensor_truth_of(
      "vignetting: {R: [-0.3, 0.05], G: [-0.28], B: []}\n"
      "veiling_glare: 0.02\n"
      "hot_pixels: {share: 0.001, counts_per_s: 200, seed: 7}\n"
      "dark_current_counts_per_s: 3\n"
      "black_drift_counts: 0.05\n"
      "non_linearity: -0.01\n"
      "shutter: thirds\n"
      "exposures: [{stated_s: 0.25, true_s: 0.265}, {stated_s: 1, true_s: 0.99}]\n");
  EXPECT_EQ(truth.vignetting_radial[0], (std::vector<double>{-0.3, 0.05}));
  EXPECT_EQ(truth.vignetting_radial[1], std::vector<double>{-0.28});
  EXPECT_TRUE(truth.vignetting_radial[2].empty());
  EXPECT_EQ(truth.veiling_glare, 0.02);
  EXPECT_EQ(truth.hot_pixel_share, 0.001);
  EXPECT_EQ(truth.hot_pixel_counts_per_s, 200.0);
  EXPECT_EQ(truth.hot_pixel_seed, 7U);
  EXPECT_EQ(truth.dark_current_counts_per_s, 3.0);
  EXPECT_EQ(truth.black_drift_counts, 0.05);
  EXPECT_EQ(truth.non_linearity, -0.01);
  EXPECT_TRUE(truth.shutter_in_thirds);
  EXPECT_EQ(truth.exposures, (std::vector<capture::TrueExposure>{{0.25, 0.265}, {1.0, 0.99}}));
}

TEST(RigSensorTruth, AnEmptySectionIsAPerfectSensor) {
  EXPECT_EQ(sensor_truth_of("shutter: stated\n"), capture::SensorTruth{});
}

TEST(RigSensorTruth, OneVignettingIsThatOfAllColours) {
  const capture::SensorTruth truth = sensor_truth_of("vignetting: [-0.4, 0.1]\n");
  for (const std::vector<double>& terms : truth.vignetting_radial) {
    EXPECT_EQ(terms, (std::vector<double>{-0.4, 0.1}));
  }
}

TEST(RigSensorTruth, NamesWhatIsWrong) {
  const auto refused = [](const std::string& text) {
    return refusal_of([&] { sensor_truth_of(text); });
  };
  // 1 - 0.7 - 0.3 leaves nothing in the corners.
  EXPECT_THAT(refused("vignetting: [-0.7, -0.3]\n"), HasSubstr("leave light in the corners"));
  EXPECT_EQ(refused("vignetting: [-0.7, -0.2]\n"), "");
  EXPECT_THAT(refused("vignetting: [0, 0, 0, 0, 0]\n"), HasSubstr("at most four terms"));
  EXPECT_THAT(refused("vignetting: {R: [0], G: [0]}\n"), HasSubstr("vignetting.B: is missing"));
  EXPECT_THAT(refused("veiling_glare: 0.6\n"), HasSubstr("veiling_glare"));
  EXPECT_THAT(refused("hot_pixels: {share: 0.01}\n"), HasSubstr("counts_per_s: is missing"));
  EXPECT_THAT(refused("hot_pixels: {share: 0.01, counts_per_s: 0}\n"), HasSubstr("positive"));
  EXPECT_THAT(refused("shutter: halves\n"), HasSubstr("expected stated or thirds, got halves"));
  EXPECT_THAT(refused("exposures: [{stated_s: 0.1}]\n"), HasSubstr("exposures[0].true_s"));
  EXPECT_THAT(refused("non_linearity: 0.4\n"), HasSubstr("non_linearity"));
  EXPECT_THAT(refused("dust: 1\n"), HasSubstr("dust: unknown key"));
}

}  // namespace
}  // namespace scattermeter::apps
