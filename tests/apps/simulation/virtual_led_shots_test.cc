#include "apps/simulation/virtual_led_shots.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/led_picture.h"
#include "apps/simulation/shot_renderer.h"
#include "capture/raw/raw_reader.h"
#include "tests/fixtures/apps/led_rig.h"
#include "tests/fixtures/apps/yaml_text.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

class VirtualLedShotsTest : public ::testing::Test {
 protected:
  VirtualLedShotsTest() {
    LedRigText text;
    text.shots += "      - {file: off.dng, kind: ambient, plane: 1}\n";
    text.truth = "truth: {ambient_irradiance_W_per_mm2: [1e-8, 1e-8, 1e-8]}\n";
    rig_ = tiny_led_rig(text);
  }
  std::vector<calib::LedCalibrationShot>& listed() { return rig_.calibration.led->shots; }
  TemporaryFolder folder_;
  Rig rig_;
};

// 0.75 of 4095 - 64 counts, the time rounded down to two digits: by at most a tenth.
TEST_F(VirtualLedShotsTest, ExposureIsChosen) {
  const VirtualLedShots shots(rig_, false);
  ASSERT_EQ(shots.size(), 4U);
  for (const std::size_t i : {0U, 1U, 2U}) {
    const std::vector<float>& counts = shots.counts(i);
    const float brightest = *std::max_element(counts.begin(), counts.end());
    EXPECT_LE(brightest, 0.75F * 4031.01F) << i;
    EXPECT_GE(brightest, 0.9F * 0.75F * 4031.0F) << i;
  }
  // With the LED off, as long as with it on.
  EXPECT_EQ(shots.exposure_s(3), shots.exposure_s(1));
}

// Responsivity x radiance x time.
TEST_F(VirtualLedShotsTest, CountsAreThePicture) {
  listed()[1].exposure_s = 0.125;
  listed()[3].exposure_s = 0.5;
  const VirtualLedShots shots(rig_, false);
  EXPECT_EQ(shots.exposure_s(1), 0.125);
  EXPECT_EQ(shots.exposure_s(3), 0.5);
  const std::vector<float> picture = led_picture(rig_, listed()[1], true_view(rig_));
  ASSERT_EQ(picture.size(), shots.counts(1).size());
  for (std::size_t i = 0; i < picture.size(); i += 7) {
    const int x = static_cast<int>(i % 120);
    const int y = static_cast<int>(i / 120);
    const auto c = static_cast<std::size_t>(rig_.scene.camera.sensor.cfa.at(x, y));
    const double expected = (*rig_.scene.camera.responsivity)[c] * 0.125 * picture[i];
    ASSERT_NEAR(shots.counts(1)[i], expected, 1e-5 * expected);
  }
}

TEST_F(VirtualLedShotsTest, WithoutAResponsivityTheNominalOneCounts) {
  for (calib::LedCalibrationShot& shot : listed()) shot.exposure_s = 0.125;
  const VirtualLedShots own(rig_, false);
  rig_.scene.camera.responsivity.reset();
  const VirtualLedShots nominal(rig_, false);
  const auto brightest = std::max_element(own.counts(1).begin(), own.counts(1).end());
  const auto i = static_cast<std::size_t>(brightest - own.counts(1).begin());
  const auto c = static_cast<std::size_t>(
      rig_.scene.camera.sensor.cfa.at(static_cast<int>(i % 120), static_cast<int>(i / 120)));
  const double ratio = std::array<double, 3>{2.4, 2.9, 2.1}[c];
  EXPECT_NEAR(*brightest / nominal.counts(1)[i], ratio, 1e-5);
}

TEST_F(VirtualLedShotsTest, FramesAreCountsAndFiles) {
  VirtualLedShots shots(rig_, false);
  shots.counts(1)[1000] = 123.0F;  // dust
  const capture::RawFrame frame = shots.frame(1, 1);
  for (std::size_t i = 0; i < frame.samples.size(); i += 11) {
    ASSERT_NEAR(frame.samples[i] - 64.0, static_cast<double>(shots.counts(1)[i]), 0.5001);
  }
  EXPECT_EQ(frame.samples[1000], 64 + 123);
  const VirtualLedShots noisy(rig_, true);
  noisy.write(2, 5, folder_ / "shot.dng");
  EXPECT_TRUE(capture::read_raw(folder_ / "shot.dng").samples == noisy.frame(2, 5).samples);
  EXPECT_FALSE(noisy.frame(2, 5).samples == noisy.frame(2, 6).samples);
}

TEST_F(VirtualLedShotsTest, NamesALightThatIsNoLed) {
  listed()[2].light = "sun";
  EXPECT_THAT(
      refusal_of([&] { VirtualLedShots(rig_, false); }),
      HasSubstr("calibration.led.shots.high_led1.dng.light: no such LED in lights, got sun"));
}

}  // namespace
}  // namespace scattermeter::apps
