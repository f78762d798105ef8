#include "calib/radiance/radiance_steps.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/calib/radiance_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

TEST(RadianceSteps, TheFirstFrameSaysWhatTheOthersAreHeldAgainst) {
  RadianceBench bench;
  const RadianceShot first = bench.shot("a", 0.1, no_light);
  open_radiance_shot(bench.steps, first);
  const capture::RadianceCorrection& c = bench.calibration.correction;
  EXPECT_EQ(c.width_px, RadianceBench::kWidth);
  EXPECT_EQ(c.height_px, RadianceBench::kHeight);
  EXPECT_EQ(c.iso, 100);
  EXPECT_EQ(c.f_number, 8);
  EXPECT_TRUE(c.vignetting.is_identity());
  const RadianceShot other = bench.shot("b", 0.2, no_light);
  EXPECT_EQ(open_radiance_shot(bench.steps, other).exposure_s, 0.2);
  bench.frames.at(other.file).iso = 200;
  EXPECT_THAT(refusal_of([&] { open_radiance_shot(bench.steps, other); }),
              HasSubstr("b1.dng: ISO 200"));
}

TEST(RadianceSteps, WhatTheFirstFrameDoesNotStateTheNextDoes) {
  RadianceBench bench;
  const RadianceShot silent = bench.shot("a", 0.1, no_light);
  bench.frames.at(silent.file).iso = bench.frames.at(silent.file).f_number = 0;
  open_radiance_shot(bench.steps, silent);
  EXPECT_EQ(bench.calibration.correction.iso, 0);
  open_radiance_shot(bench.steps, bench.shot("b", 0.1, no_light));
  EXPECT_EQ(bench.calibration.correction.iso, 100);
  EXPECT_EQ(bench.calibration.correction.f_number, 8);
}

TEST(RadianceSteps, AFrameNeedsAnExposureTime) {
  RadianceBench bench;
  const RadianceShot shot = bench.shot("a", 0.1, no_light);
  bench.frames.at(shot.file).exposure_s = 0;
  EXPECT_THAT(refusal_of([&] { open_radiance_shot(bench.steps, shot); }),
              HasSubstr("no exposure time"));
}

TEST(RadianceSteps, MarksClippedSamplesAndDefects) {
  RadianceBench bench;
  const RadianceShot shot = bench.shot("a", 1.0, no_light);
  capture::RawFrame& frame = bench.frames.at(shot.file);
  frame.samples[100] = 4095;
  frame.samples[101] = 4000;
  capture::RadianceCorrection correction;
  correction.defect_pixels = {7, 200};
  const std::vector<std::uint8_t> marks = marks_of(frame, correction);
  EXPECT_EQ(marks[7], kSampleDefect);
  EXPECT_EQ(marks[200], kSampleDefect);
  EXPECT_EQ(marks[100], kSampleClipped);
  EXPECT_EQ(marks[101], 0);
  EXPECT_EQ(std::count(marks.begin(), marks.end(), 0),
            static_cast<std::ptrdiff_t>(marks.size()) - 3);
}

TEST(RadianceSteps, BlackGrowsWithTheExposure) {
  capture::RadianceCorrection correction;
  correction.black_counts = {60, 61, 62, 63};
  correction.dark_counts_per_s = {1, 2, 3, 4};
  EXPECT_EQ(black_at(correction, 2.0), (std::array<double, 4>{62, 65, 68, 71}));
}

}  // namespace
}  // namespace scattermeter::calib
