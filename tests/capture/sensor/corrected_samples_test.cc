#include "capture/sensor/corrected_samples.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "capture/sensor/linear_samples.h"

namespace scattermeter::capture {
namespace {

constexpr int kSamplesWidth = 60, kSamplesHeight = 40;

// A frame of a sensor with every fault that the correction knows, without noise: light of `counts`
// in the upper half, none below.
struct FaultyCamera {
  RadianceCorrection correction;
  RawFrame frame;

  explicit FaultyCamera(double counts) {
    correction.width_px = frame.width_px = kSamplesWidth;
    correction.height_px = frame.height_px = kSamplesHeight;
    correction.iso = frame.iso = 100;
    correction.f_number = frame.f_number = 8;
    frame.exposure_s = 0.5;
    frame.white_counts = 4095;
    frame.black_counts = {50, 50, 50, 50};  // what the file says
    correction.black_counts = {60, 61, 62, 63};
    correction.dark_counts_per_s = {4, 4, 4, 4};
    correction.noise.fill({6.0, 1.2});
    correction.black_std_counts = 0.25;
    correction.response.fill(ResponseCurve({2000, 4000}, {0.004, 0.012}));
    correction.vignetting = vignetting_of_frame(kSamplesWidth, kSamplesHeight);
    correction.vignetting.radial = {std::vector<double>{-0.2}, {-0.3}, {-0.4}};
    const double glare = 0.05;
    correction.glare_share.fill(glare / (1 + glare));
    correction.shutter = {{0.5, 1.04, 0.002}};
    correction.defect_pixels = {7, 7 + kSamplesWidth};
    // Light -> vignetting -> glare -> departure -> black.
    std::vector<double> light(kSamplesWidth * kSamplesHeight);
    std::array<double, 3> sum{}, n{};
    for (int y = 0; y < kSamplesHeight; ++y) {
      for (int x = 0; x < kSamplesWidth; ++x) {
        const auto c = static_cast<std::size_t>(frame.cfa.at(x, y));
        const double l =
            y < kSamplesHeight / 2 ? counts * correction.vignetting.share(x, y, c) : 0.0;
        light[static_cast<std::size_t>(y * kSamplesWidth + x)] = l;
        sum[c] += l;
        n[c] += 1.0;
      }
    }
    for (int y = 0; y < kSamplesHeight; ++y) {
      for (int x = 0; x < kSamplesWidth; ++x) {
        const auto c = static_cast<std::size_t>(frame.cfa.at(x, y));
        const auto i = static_cast<std::size_t>(y * kSamplesWidth + x);
        const double l = light[i] + glare * sum[c] / n[c];
        double recorded = l;
        for (int k = 0; k < 60; ++k) {
          recorded = l / std::exp(correction.response[c].log_ratio_at(recorded));
        }
        const std::size_t phase = cfa_phase(x, y);
        frame.samples.push_back(static_cast<std::uint16_t>(
            std::lround(recorded + correction.black_counts[phase] + 2.0)));
      }
    }
    for (const std::size_t i : correction.defect_pixels) frame.samples[i] = 4000;
  }
};

TEST(CorrectedSamples, UndoesEveryFaultInItsOrder) {
  const FaultyCamera camera(3000);
  const CorrectedSamples out =
      corrected_samples(camera.frame, camera.correction, 0, 0, kSamplesWidth, kSamplesHeight);
  EXPECT_NEAR(out.samples.exposure_s, 0.52, 1e-12);
  EXPECT_EQ(out.exposure_relative_std, 0.002);
  EXPECT_EQ(out.black_std_counts, 0.25);
  for (int y = 0; y < kSamplesHeight; ++y) {
    for (int x = 0; x < kSamplesWidth; ++x) {
      const auto i = static_cast<std::size_t>(y * kSamplesWidth + x);
      if (out.samples.clipped[i] == kSampleDefect) continue;
      ASSERT_EQ(out.samples.clipped[i], 0);
      // Rounding to a count, over a share of at least 0.6.
      ASSERT_NEAR(out.samples.signal_counts[i], y < kSamplesHeight / 2 ? 3000.0 : 0.0, 1.0)
          << x << ", " << y;
    }
  }
  EXPECT_EQ(out.samples.clipped[7], kSampleDefect);
  EXPECT_EQ(out.samples.clipped[7 + kSamplesWidth], kSampleDefect);
}

TEST(CorrectedSamples, ARectangleIsAPartOfTheFrame) {
  const FaultyCamera camera(2000);
  const CorrectedSamples whole =
      corrected_samples(camera.frame, camera.correction, 0, 0, kSamplesWidth, kSamplesHeight);
  const CorrectedSamples part = corrected_samples(camera.frame, camera.correction, 5, 3, 20, 10);
  EXPECT_EQ(part.frame_mean_counts, whole.frame_mean_counts);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      const auto i = static_cast<std::size_t>(y * 20 + x);
      const auto k = static_cast<std::size_t>((y + 3) * kSamplesWidth + x + 5);
      EXPECT_EQ(part.samples.signal_counts[i], whole.samples.signal_counts[k]);
      EXPECT_EQ(part.samples.clipped[i], whole.samples.clipped[k]);
    }
  }
}

// A calibration that finds nothing changes nothing.
TEST(CorrectedSamples, OfAFaultlessCameraAreTheLinearOnes) {
  const FaultyCamera camera(2000);
  RadianceCorrection none;
  none.width_px = kSamplesWidth;
  none.height_px = kSamplesHeight;
  none.black_counts = {50, 50, 50, 50};
  none.noise.fill({6.0, 1.2});
  none.vignetting = vignetting_of_frame(kSamplesWidth, kSamplesHeight);
  const CfaSamples plain = linear_samples(camera.frame, {6.0, 1.2}, 0.5, 2, 2, 20, 10);
  const CfaSamples same = corrected_samples(camera.frame, none, 2, 2, 20, 10).samples;
  EXPECT_EQ(same.signal_counts, plain.signal_counts);
  EXPECT_EQ(same.variance_counts2, plain.variance_counts2);
  EXPECT_EQ(same.clipped, plain.clipped);
  EXPECT_EQ(same.floor_counts, plain.floor_counts);
  EXPECT_EQ(same.exposure_s, plain.exposure_s);
  EXPECT_NEAR(same.variance_per_count, plain.variance_per_count, 1e-12);
}

TEST(CorrectedSamples, BeyondTheCalibratedRangeIsClipped) {
  FaultyCamera camera(1000);
  camera.correction.response.fill(ResponseCurve({500, 900}, {0.001, 0.002}));
  const CorrectedSamples out =
      corrected_samples(camera.frame, camera.correction, 30, 16, 2, 2);  // at the centre
  EXPECT_EQ(out.samples.clipped[0], kSampleClipped);
}

TEST(CorrectedSamples, RefusesShotsOfAnotherSetting) {
  FaultyCamera camera(1000);
  EXPECT_EQ(correction_problem(camera.frame, camera.correction), "");
  camera.frame.iso = 400;
  EXPECT_EQ(correction_problem(camera.frame, camera.correction),
            "ISO 400, but the radiance calibration is for ISO 100");
  EXPECT_THROW(corrected_samples(camera.frame, camera.correction, 0, 0, 2, 2),
               std::invalid_argument);
  camera.frame.iso = 0;  // not in the file
  EXPECT_EQ(correction_problem(camera.frame, camera.correction), "");
  camera.frame.f_number = 5.6;
  EXPECT_EQ(correction_problem(camera.frame, camera.correction),
            "aperture f/5.6, but the radiance calibration is for f/8");
  camera.correction.width_px = 62;
  EXPECT_NE(correction_problem(camera.frame, camera.correction).find("60 x 40"), std::string::npos);
}

TEST(CorrectedSamples, RefusesRectanglesOutOfTheFrame) {
  const FaultyCamera camera(1000);
  EXPECT_THROW(corrected_samples(camera.frame, camera.correction, 50, 0, 20, 4),
               std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::capture
