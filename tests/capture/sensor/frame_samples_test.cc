#include "capture/sensor/frame_samples.h"

#include <gtest/gtest.h>

#include "capture/sensor/linear_samples.h"
#include "core/base/input_error.h"
#include "core/camera/sensor_noise.h"

namespace scattermeter::capture {
namespace {

RawFrame frame_8_by_6() {
  RawFrame frame;
  frame.width_px = 8;
  frame.height_px = 6;
  frame.exposure_s = 0.5;
  frame.iso = 100;
  frame.f_number = 8;
  frame.black_counts.fill(64);
  frame.white_counts = 4095;
  for (int i = 0; i < 48; ++i) frame.samples.push_back(static_cast<std::uint16_t>(100 + 7 * i));
  return frame;
}

RadianceCorrection correction_of(const RawFrame& frame) {
  RadianceCorrection correction;
  correction.width_px = frame.width_px;
  correction.height_px = frame.height_px;
  correction.iso = frame.iso;
  correction.f_number = frame.f_number;
  correction.black_counts.fill(60);
  correction.black_std_counts = 0.25;
  correction.noise.fill({6.0, 1.2});
  correction.vignetting = vignetting_of_frame(frame.width_px, frame.height_px);
  return correction;
}

TEST(FrameSamples, WithoutACorrectionAreLinearSamples) {
  const RawFrame frame = frame_8_by_6();
  const SensorNoise noise{6.0, 1.2};
  const CorrectedSamples samples =
      frame_samples(frame, noise, nullptr, "a.dng", PixelRect{2, 2, 4, 2});
  const CfaSamples linear = linear_samples(frame, noise, 0.5, 2, 2, 4, 2);
  EXPECT_EQ(samples.samples.signal_counts, linear.signal_counts);
  EXPECT_EQ(samples.samples.variance_counts2, linear.variance_counts2);
  EXPECT_EQ(samples.samples.exposure_s, 0.5);
  EXPECT_EQ(samples.black_std_counts, 0.0);
  EXPECT_EQ(samples.exposure_relative_std, 0.0);
}

TEST(FrameSamples, WithACorrectionAreCorrectedSamples) {
  const RawFrame frame = frame_8_by_6();
  const RadianceCorrection correction = correction_of(frame);
  const CorrectedSamples samples =
      frame_samples(frame, {1.0, 9.0}, &correction, "a.dng", {2, 2, 4, 2});
  const CorrectedSamples corrected = corrected_samples(frame, correction, 2, 2, 4, 2);
  EXPECT_EQ(samples.samples.signal_counts, corrected.samples.signal_counts);
  EXPECT_EQ(samples.samples.variance_counts2, corrected.samples.variance_counts2);
  EXPECT_EQ(samples.black_std_counts, 0.25);
  EXPECT_NEAR(samples.samples.signal_counts[0], frame.at(2, 2) - 60.0, 1e-3);
}

TEST(FrameSamples, AFrameOfAnotherIsoIsRefusedByName) {
  RawFrame frame = frame_8_by_6();
  const RadianceCorrection correction = correction_of(frame);
  frame.iso = 400;
  try {
    frame_samples(frame, {6.0, 1.2}, &correction, "a.dng", {2, 2, 4, 2});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("a.dng: ISO 400"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scattermeter::capture
