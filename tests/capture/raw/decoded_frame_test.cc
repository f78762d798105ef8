#include "capture/raw/decoded_frame.h"

#include <stdexcept>

#include <gtest/gtest.h>

#include "capture/raw/dng_writer.h"
#include "capture/raw/nef_writer.h"
#include "capture/raw/raw_reader.h"
#include "capture/raw/tone_curve.h"
#include "tests/fixtures/capture/tiff_bytes.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

// Everything that the measurement reads of a frame.
void expect_same(const RawFrame& a, const RawFrame& b) {
  EXPECT_EQ(a.width_px, b.width_px);
  EXPECT_EQ(a.height_px, b.height_px);
  EXPECT_TRUE(a.samples == b.samples);
  EXPECT_EQ(a.cfa, b.cfa);
  EXPECT_EQ(a.black_counts, b.black_counts);
  EXPECT_EQ(a.white_counts, b.white_counts);
  EXPECT_TRUE(a.curve_levels == b.curve_levels);
  EXPECT_EQ(a.exposure_s, b.exposure_s);
  EXPECT_EQ(a.iso, b.iso);
  EXPECT_EQ(a.f_number, b.f_number);
}

TEST(DecodedFrame, IsWhatTheReaderMakesOfTheFile) {
  const TemporaryFolder folder;
  RawMetadata metadata;
  metadata.cfa = cfa_pattern_from_name("GRBG");
  metadata.black_counts = {60, 61, 62, 63};
  metadata.white_counts = 4000;
  metadata.exposure_s = 0.05;
  metadata.iso = 200;
  metadata.f_number = 11;
  const std::vector<std::uint16_t> codes = random_image(64, 48, 12).codes;
  write_dng(folder / "shot.dng", 64, 48, codes, metadata);
  expect_same(decoded_frame(64, 48, codes, metadata), read_raw(folder / "shot.dng"));
}

TEST(DecodedFrame, GoesThroughTheToneCurve) {
  const TemporaryFolder folder;
  RawMetadata metadata;
  metadata.linearization_table = nef_lossy_curve();
  std::vector<std::uint16_t> codes = random_image(64, 48, 12).codes;
  for (std::uint16_t& code : codes) {
    code = static_cast<std::uint16_t>(code % metadata.linearization_table.size());
  }
  write_dng(folder / "shot.dng", 64, 48, codes, metadata);
  const RawFrame frame = decoded_frame(64, 48, codes, metadata);
  EXPECT_EQ(frame.curve_levels.back(), 3880);
  expect_same(frame, read_raw(folder / "shot.dng"));
  write_nef(folder / "shot.nef", 64, 48, codes, metadata);
  expect_same(frame, read_raw(folder / "shot.nef"));
}

TEST(DecodedFrame, RefusesCodesThatDoNotFit) {
  RawMetadata metadata;
  EXPECT_THROW(decoded_frame(4, 4, std::vector<std::uint16_t>(15), metadata),
               std::invalid_argument);
  metadata.linearization_table = {0, 5};
  EXPECT_THROW(decoded_frame(2, 2, {0, 1, 2, 0}, metadata), std::invalid_argument);
}

TEST(RawFrame, SamplesStandRowByRow) {
  RawFrame frame;
  frame.width_px = 3;
  frame.height_px = 2;
  frame.samples = {0, 1, 2, 10, 11, 12};
  EXPECT_EQ(frame.at(2, 1), 12);
  EXPECT_EQ(frame.at(1, 0), 1);
}

}  // namespace
}  // namespace scattermeter::capture
