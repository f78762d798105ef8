#include "capture/raw/raw_reader.h"

#include <algorithm>
#include <filesystem>
#include <future>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/dng_writer.h"
#include "capture/raw/tone_curve.h"
#include "core/base/input_error.h"
#include "tests/fixtures/capture/process.h"
#include "tests/fixtures/capture/tiff_bytes.h"
#include "tests/fixtures/shared_file.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;

// Sample for sample, wherever the decoders put the corner of the active area.
void expect_same_samples(const RawFrame& ours, const DcrawFrame& dcraw, int shift_x, int shift_y) {
  ASSERT_EQ(ours.width_px + shift_x, dcraw.width_px);
  ASSERT_EQ(ours.height_px + shift_y, dcraw.height_px);
  std::size_t different = 0;
  for (int y = 0; y < ours.height_px; ++y) {
    for (int x = 0; x < ours.width_px; ++x) {
      const int at = (y + shift_y) * dcraw.width_px + x + shift_x;
      different += ours.at(x, y) != dcraw.samples[static_cast<std::size_t>(at)] ? 1 : 0;
    }
  }
  EXPECT_EQ(different, 0U);
}

std::vector<unsigned> as_unsigned(const std::vector<std::uint16_t>& values) {
  return {values.begin(), values.end()};
}

struct Layout {
  unsigned width, height, bits, left, top, right, bottom;
  bool curve;
  bool jpeg;
};

class AgainstDcraw : public testing::TestWithParam<Layout> {};

TEST_P(AgainstDcraw, EverySampleIsTheSame) {
  const Layout& layout = GetParam();
  TestImage image = random_image(layout.width, layout.height, layout.bits);
  CfaDng dng(image);
  dng.longs(50829, {layout.top, layout.left, layout.bottom, layout.right});
  std::vector<std::uint16_t> curve;
  if (layout.curve) {
    curve = nef_lossy_curve();
    for (std::uint16_t& code : image.codes) code = static_cast<std::uint16_t>(code % curve.size());
    dng.shorts(50712, as_unsigned(curve));
  }
  if (layout.jpeg) dng.shorts(259, {7});
  const TemporaryFolder folder;
  const std::string path = folder / "shot.dng";
  write_file(path, dng.file({layout.jpeg ? lossless_jpeg_rows(image, 0, image.height)
                                         : packed_rows(image, 0, image.height)}));
  const RawFrame frame = read_raw(path);

  // An odd corner moves to the next even place; dcraw leaves it.
  const int shift_x = static_cast<int>(layout.left % 2);
  const int shift_y = static_cast<int>(layout.top % 2);
  EXPECT_EQ(frame.left_margin_px, static_cast<int>(layout.left) + shift_x);
  EXPECT_EQ(frame.top_margin_px, static_cast<int>(layout.top) + shift_y);
  expect_same_samples(frame, dcraw_frame(path), shift_x, shift_y);
  // And both are what was put in.
  for (int y = 0; y < frame.height_px; ++y) {
    for (int x = 0; x < frame.width_px; ++x) {
      const auto at = static_cast<std::size_t>(y + frame.top_margin_px) * layout.width +
                      static_cast<std::size_t>(x + frame.left_margin_px);
      const std::uint16_t code = image.codes[at];
      ASSERT_EQ(frame.at(x, y), layout.curve ? curve[code] : code) << x << ", " << y;
    }
  }
  EXPECT_EQ(frame.curve_levels, curve);
}

INSTANTIATE_TEST_SUITE_P(Layouts, AgainstDcraw,
                         testing::Values(Layout{64, 48, 12, 0, 0, 64, 48, false, false},
                                         Layout{64, 48, 12, 4, 2, 60, 44, false, false},
                                         Layout{64, 48, 12, 3, 0, 60, 44, false, false},
                                         Layout{64, 48, 12, 0, 3, 61, 45, true, false},
                                         Layout{64, 48, 12, 5, 7, 64, 48, false, false},
                                         Layout{130, 94, 10, 2, 0, 130, 94, false, false},
                                         Layout{130, 94, 14, 0, 2, 126, 94, false, false},
                                         Layout{130, 94, 16, 6, 6, 124, 90, false, false},
                                         Layout{66, 50, 12, 0, 0, 66, 50, true, false},
                                         Layout{66, 50, 14, 2, 2, 66, 50, true, false},
                                         Layout{64, 48, 12, 0, 0, 64, 48, false, true},
                                         Layout{128, 48, 14, 2, 2, 126, 48, false, true}));

TEST(RawReader, WholeFrameOfAD80EqualsDcraw) {
  const TemporaryFolder folder;
  const std::string path = folder / "d80.dng";
  RawMetadata metadata;
  metadata.linearization_table = nef_lossy_curve();
  TestImage image = random_image(3872, 2592, 12);
  for (std::uint16_t& code : image.codes) code = static_cast<std::uint16_t>(code % 683);
  write_dng(path, 3872, 2592, image.codes, metadata);
  expect_same_samples(read_raw(path), dcraw_frame(path), 0, 0);
}

TEST(RawReader, PhotographedChartEqualsDcraw) {
  const std::string path = shared_file("data/raw/tinydng_colorchart.dng");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << shared_file_missing(path);
  const RawFrame frame = read_raw(path);
  expect_same_samples(frame, dcraw_frame(path), 0, 0);
  EXPECT_EQ(frame.width_px, 1734);  // exiftool: ActiveArea 26 152 1182 1886
  EXPECT_EQ(frame.height_px, 1156);
  EXPECT_EQ(frame.left_margin_px, 152);
  EXPECT_EQ(frame.top_margin_px, 26);
  EXPECT_EQ(cfa_pattern_name(frame.cfa), "RGGB");
  EXPECT_THAT(frame.black_counts, ElementsAre(2056, 2056, 2056, 2056));
  EXPECT_EQ(frame.white_counts, 15000);
  EXPECT_TRUE(frame.curve_levels.empty());
  EXPECT_EQ(frame.model, "EOS Kiss X4");
}

// A photograph in the compression that Nikon's cameras of 2003 to 2007 write.
TEST(RawReader, PhotographedNefEqualsDcraw) {
  const std::string path = shared_file("data/raw/nikon_d2h_12bit_compressed.nef");
  if (!std::filesystem::exists(path)) GTEST_SKIP() << shared_file_missing(path);
  const RawFrame frame = read_raw(path);
  expect_same_samples(frame, dcraw_frame(path), 0, 0);
  EXPECT_EQ(cfa_pattern_name(frame.cfa), "GBRG");
  EXPECT_THAT(frame.black_counts, ElementsAre(0, 0, 0, 0));
  EXPECT_EQ(frame.white_counts, 4095);
  EXPECT_EQ(frame.curve_levels.size(), 683U);
  EXPECT_EQ(frame.exposure_s, 0.002);
  EXPECT_EQ(frame.iso, 200);
  EXPECT_EQ(frame.f_number, 8);
  EXPECT_EQ(frame.model, "D2H");
}

TEST(RawReader, PatternCountsFromTheActiveAreasCorner) {
  const TemporaryFolder folder;
  const TestImage image = random_image(64, 48, 12);
  for (const std::string name : {"RGGB", "GRBG", "GBRG", "BGGR"}) {
    for (const unsigned left : {0U, 2U, 3U}) {
      for (const unsigned top : {0U, 1U, 4U}) {
        const CfaPattern pattern = cfa_pattern_from_name(name);
        CfaDng dng(image);
        Bytes colors;
        for (const Channel c : pattern.phase) colors.push_back(static_cast<std::uint8_t>(c));
        dng.bytes(33422, colors);
        dng.longs(50829, {top, left, 46, 62});
        dng.shorts(50713, {2, 2});
        dng.shorts(50714, {60, 61, 62, 63});
        write_file(folder / "shot.dng", dng.file({packed_rows(image, 0, 48)}));
        const RawFrame frame = read_raw(folder / "shot.dng");
        const int shift_x = frame.left_margin_px - static_cast<int>(left);
        const int shift_y = frame.top_margin_px - static_cast<int>(top);
        for (int phase = 0; phase < 4; ++phase) {
          const int x = phase % 2;
          const int y = phase / 2;
          EXPECT_EQ(frame.cfa.at(x, y), pattern.at(x + shift_x, y + shift_y))
              << name << " corner " << left << ", " << top << " phase " << phase;
          EXPECT_EQ(frame.black_counts[static_cast<std::size_t>(phase)],
                    60 + (x + shift_x) % 2 + 2 * ((y + shift_y) % 2))
              << name << " corner " << left << ", " << top << " phase " << phase;
        }
      }
    }
  }
}

TEST(RawReader, BlackLevelOfEveryKind) {
  const TemporaryFolder folder;
  const TestImage image = random_image(64, 48, 12);
  const auto black = [&](const std::vector<unsigned>& dim, const std::vector<unsigned>& halves) {
    CfaDng dng(image);
    dng.shorts(50713, dim);
    dng.rationals(50714, halves, 2);
    write_file(folder / "shot.dng", dng.file({packed_rows(image, 0, 48)}));
    return read_raw(folder / "shot.dng").black_counts;
  };
  EXPECT_THAT(black({1, 1}, {128}), ElementsAre(64, 64, 64, 64));
  EXPECT_THAT(black({1, 1}, {255}), ElementsAre(127.5, 127.5, 127.5, 127.5));
  EXPECT_THAT(black({2, 2}, {20, 23, 24, 27}), ElementsAre(10, 11.5, 12, 13.5));
  EXPECT_THAT(black({1, 2}, {20, 22}), ElementsAre(10, 11, 10, 11));
  EXPECT_THAT(black({2, 1}, {20, 22}), ElementsAre(10, 10, 11, 11));
  // A 4 x 4 pattern 1 .. 16: the mean of the four places of each phase, 1, 3, 9, 11 for the first.
  std::vector<unsigned> halves;
  for (unsigned i = 1; i <= 16; ++i) halves.push_back(2 * i);
  EXPECT_THAT(black({4, 4}, halves), ElementsAre(6, 7, 10, 11));
}

TEST(RawReader, KnownCamerasGetNoOtherLevels) {
  // LibRaw has tables of levels and frame sizes by camera name; none of it may reach a DNG.
  const TemporaryFolder folder;
  struct Camera {
    const char *make, *model, *make_read, *model_read;
  };
  for (const Camera& camera :
       {Camera{"NIKON CORPORATION", "NIKON D80", "Nikon", "D80"},
        Camera{"NIKON CORPORATION", "NIKON D850", "Nikon", "D850"},
        Camera{"Canon", "Canon EOS 5D", "Canon", "EOS 5D"},
        Camera{"SONY", "ILCE-7M3", "Sony", "ILCE-7M3"}, Camera{"Acme", "Acme X1", "Acme", "X1"}}) {
    for (const bool full_size : {false, true}) {
      const int width = full_size ? 3872 : 90;
      const int height = full_size ? 2592 : 64;
      RawMetadata metadata;
      metadata.make = camera.make;
      metadata.model = camera.model;
      metadata.cfa = cfa_pattern_from_name("GBRG");
      metadata.black_counts = {60, 61, 62, 63};
      metadata.white_counts = 4000;
      metadata.exposure_s = 1.0 / 30;
      metadata.iso = 400;
      metadata.f_number = 5.6;
      const auto samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
      write_dng(folder / "shot.dng", width, height, std::vector<std::uint16_t>(samples, 1234),
                metadata);
      const RawFrame frame = read_raw(folder / "shot.dng");
      SCOPED_TRACE(camera.model);
      EXPECT_EQ(frame.width_px, width);
      EXPECT_EQ(frame.height_px, height);
      EXPECT_EQ(frame.left_margin_px, 0);
      EXPECT_EQ(frame.top_margin_px, 0);
      EXPECT_EQ(cfa_pattern_name(frame.cfa), "GBRG");
      EXPECT_THAT(frame.black_counts, ElementsAre(60, 61, 62, 63));
      EXPECT_EQ(frame.white_counts, 4000);
      EXPECT_NEAR(frame.exposure_s, 1.0 / 30, 1e-8);  // LibRaw keeps a float
      EXPECT_EQ(frame.iso, 400);
      EXPECT_EQ(frame.f_number, 5.6);
      EXPECT_EQ(frame.make, camera.make_read);
      EXPECT_EQ(frame.model, camera.model_read);
      EXPECT_EQ(std::count(frame.samples.begin(), frame.samples.end(), 1234), width * height);
    }
  }
}

TEST(RawReader, MissingExposureReadsAsZero) {
  const TemporaryFolder folder;
  const TestImage image = random_image(64, 48, 12);
  CfaDng dng(image);
  dng.exif = nullptr;
  write_file(folder / "shot.dng", dng.file({packed_rows(image, 0, 48)}));
  const RawFrame frame = read_raw(folder / "shot.dng");
  EXPECT_EQ(frame.exposure_s, 0);
  EXPECT_EQ(frame.iso, 0);
  EXPECT_EQ(frame.f_number, 0);
}

TEST(RawReader, SeveralThreadsReadTheSameAsOne) {
  const TemporaryFolder folder;
  std::vector<std::future<RawFrame>> frames;
  std::vector<TestImage> images;
  for (unsigned i = 0; i < 8; ++i) {
    images.push_back(random_image(130, 94, 12, i));
    CfaDng dng(images[i]);
    write_file(folder / (std::to_string(i) + ".dng"), dng.file({packed_rows(images[i], 0, 94)}));
  }
  for (unsigned i = 0; i < 8; ++i) {
    frames.push_back(
        std::async(std::launch::async, read_raw, folder / (std::to_string(i) + ".dng"), 400.0));
  }
  for (unsigned i = 0; i < 8; ++i) EXPECT_EQ(frames[i].get().samples, images[i].codes);
}

}  // namespace
}  // namespace scattermeter::capture
