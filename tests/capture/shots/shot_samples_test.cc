#include "capture/shots/shot_samples.h"

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/sensor/linear_samples.h"
#include "capture/sensor/radiance_calibration.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {
namespace {

using ::testing::HasSubstr;

constexpr int kSide = 24;

Scene bracket_scene() {
  Scene scene;
  scene.source = "rig.yaml";
  scene.camera.sensor.noise = {5.0, 2.0};
  scene.shots.resize(1);
  scene.shots[0].file = "long.dng";
  scene.shots[0].more_files = {"short.dng"};
  scene.shots[0].line = 4;
  return scene;
}

// Light that grows by 100 counts a second from column to column, over black 64 and without noise.
RawFrame ramp_frame(double exposure_s) {
  RawFrame frame;
  frame.width_px = frame.height_px = kSide;
  frame.black_counts.fill(64.0);
  frame.white_counts = 4095;
  frame.exposure_s = exposure_s;
  frame.iso = 100;
  frame.f_number = 8;
  frame.make = "Nikon";
  frame.model = "D80";
  for (int i = 0; i < kSide * kSide; ++i) {
    frame.samples.push_back(
        static_cast<std::uint16_t>(std::min(4095.0, 64.0 + 100.0 * (i % kSide + 1) * exposure_s)));
  }
  return frame;
}

ShotSamples samples_of(const std::vector<RawFrame>& frames, const ShotDecoding& decoding = {}) {
  const Scene scene = bracket_scene();
  SceneShot shot = scene.shots[0];
  if (frames.size() == 1) shot.more_files.clear();
  std::vector<std::string> names = {"/shots/long.dng", "/shots/short.dng"};
  names.resize(frames.size());
  return shot_samples(scene, decoding, shot, frames, names, 2, 4, 20, 10);
}

TEST(ShotSamples, OfOneExposureAreItsLinearSamples) {
  const ShotSamples one = samples_of({ramp_frame(2.0)});
  const CfaSamples plain = linear_samples(ramp_frame(2.0), {5.0, 2.0}, 2.0, 2, 4, 20, 10);
  EXPECT_EQ(one.samples.signal_counts, plain.signal_counts);
  EXPECT_EQ(one.samples.variance_counts2, plain.variance_counts2);
  EXPECT_EQ(one.samples.exposure_s, 2.0);
  ASSERT_EQ(one.exposures.size(), 1U);
  EXPECT_EQ(one.exposures[0].file, "long.dng");
  EXPECT_EQ(one.exposures[0].stated_s, 2.0);
  EXPECT_EQ(one.exposures[0].true_s, 2.0);
  EXPECT_EQ(one.frame_mean_counts, (std::array<double, kRgb>{}));
}

// Of 4 s and 1 s, where the long one clips from column 10 on: everywhere in counts of the long one.
TEST(ShotSamples, ABracketIsInCountsOfItsFirstExposure) {
  const ShotSamples merged = samples_of({ramp_frame(4.0), ramp_frame(1.0)});
  EXPECT_EQ(merged.samples.exposure_s, 4.0);
  for (int x = 0; x < 20; ++x) {
    const auto i = static_cast<std::size_t>(x);
    EXPECT_EQ(merged.samples.clipped[i], 0) << x;
    EXPECT_NEAR(merged.samples.signal_counts[i], 400.0 * (x + 2 + 1), 1e-2) << x;
  }
  ASSERT_EQ(merged.exposures.size(), 2U);
  EXPECT_EQ(merged.exposures[1].file, "short.dng");
  EXPECT_NEAR(merged.exposures[0].departure.log_ratio, 0.0, 1e-6);
}

// A short exposure that is in truth 10 % longer than stated shows as a departure.
TEST(ShotSamples, ADepartureIsTheLogOfTheRatio) {
  RawFrame off = ramp_frame(1.1);
  off.exposure_s = 1.0;
  const ShotSamples merged = samples_of({ramp_frame(2.0), off});
  EXPECT_NEAR(merged.exposures[1].departure.log_ratio, std::log(1.1), 1e-6);
  EXPECT_NEAR(merged.exposures[0].departure.log_ratio, -std::log(1.1), 1e-6);
}

TEST(ShotSamples, ACalibrationsTrueTimesCount) {
  auto calibration = std::make_shared<RadianceCalibration>();
  RadianceCorrection& c = calibration->correction;
  c.width_px = c.height_px = kSide;
  c.black_counts.fill(64.0);
  c.noise.fill({5.0, 2.0});
  c.vignetting = vignetting_of_frame(kSide, kSide);
  c.shutter = {{1.0, 1.1, 0.001}};
  RawFrame off = ramp_frame(1.1);
  off.exposure_s = 1.0;
  const ShotSamples merged = samples_of({ramp_frame(2.0), off}, {calibration, "", 400});
  EXPECT_DOUBLE_EQ(merged.exposures[1].true_s, 1.1);
  EXPECT_EQ(merged.exposures[1].relative_std, 0.001);
  EXPECT_NEAR(merged.exposures[1].departure.log_ratio, 0.0, 1e-6);
  // The mean of the ramp, 1250 counts a second, taken from the shortest exposure.
  for (const double mean : merged.frame_mean_counts) EXPECT_NEAR(mean, 2500.0, 110.0);
}

TEST(ShotSamples, RefusesABracketOfDifferentShots) {
  const auto refusal = [](const auto& change) {
    RawFrame other = ramp_frame(1.0);
    change(other);
    try {
      samples_of({ramp_frame(2.0), other});
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(refusal([](RawFrame&) {}), "");
  EXPECT_EQ(refusal([](RawFrame& f) { f.iso = 0; }), "");  // not stated
  EXPECT_THAT(refusal([](RawFrame& f) { f.iso = 200; }), HasSubstr("ISO 200"));
  EXPECT_THAT(refusal([](RawFrame& f) { f.f_number = 11; }), HasSubstr("f/11"));
  EXPECT_THAT(refusal([](RawFrame& f) { f.model = "D90"; }), HasSubstr("D90"));
  EXPECT_THAT(refusal([](RawFrame& f) { f.cfa = cfa_pattern_from_name("BGGR"); }),
              HasSubstr("BGGR"));
  const std::string size = refusal([](RawFrame& f) { f.height_px = 20; });
  EXPECT_THAT(size, HasSubstr("/shots/short.dng"));
  EXPECT_THAT(size, HasSubstr("rig.yaml:4"));
}

TEST(ShotSamples, NeedsAFrameForEachFile) {
  const Scene scene = bracket_scene();
  EXPECT_THROW(shot_samples(scene, {}, scene.shots[0], {ramp_frame(1.0)}, {"a"}, 0, 0, 2, 2),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
