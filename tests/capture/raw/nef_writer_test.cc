#include "capture/raw/nef_writer.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <numeric>
#include <random>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/raw_reader.h"
#include "capture/raw/tone_curve.h"
#include "core/base/input_error.h"
#include "tests/fixtures/capture/process.h"
#include "tests/fixtures/capture/tiff_bytes.h"
#include "tests/fixtures/draws.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;

RawMetadata d80() {
  RawMetadata metadata;
  metadata.linearization_table = nef_lossy_curve();
  return metadata;
}

class NefWriter : public testing::Test {
 protected:
  void write(int width_px, int height_px, const RawMetadata& metadata = d80(), unsigned seed = 1) {
    codes_ =
        random_image(static_cast<unsigned>(width_px), static_cast<unsigned>(height_px), 12, seed)
            .codes;
    for (std::uint16_t& code : codes_) code = static_cast<std::uint16_t>(code % 683);
    write_nef(path_, width_px, height_px, codes_, metadata);
  }
  std::vector<std::uint16_t> values() const {
    const std::vector<std::uint16_t> curve = nef_lossy_curve();
    std::vector<std::uint16_t> out;
    for (const std::uint16_t code : codes_) out.push_back(curve[code]);
    return out;
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "shot.NEF";
  std::vector<std::uint16_t> codes_;
};

TEST_F(NefWriter, LibRawReadsTheFrameOfAD80) {
  write(3872, 2592);
  const RawFrame frame = read_raw(path_);
  EXPECT_EQ(frame.width_px, 3872);
  EXPECT_EQ(frame.height_px, 2592);
  EXPECT_TRUE(frame.samples == values());
  EXPECT_EQ(frame.curve_levels, nef_lossy_curve());
  EXPECT_EQ(frame.white_counts, 4095);
  EXPECT_EQ(frame.make, "Nikon");
  EXPECT_EQ(frame.model, "D80");
}

TEST_F(NefWriter, DcrawReadsTheSame) {
  if (!is_installed("dcraw")) GTEST_SKIP() << "dcraw is not installed";
  write(968, 648);
  const DcrawFrame frame = dcraw_frame(path_);
  EXPECT_EQ(frame.width_px, 968);
  EXPECT_EQ(frame.height_px, 648);
  EXPECT_TRUE(frame.samples == values());
}

TEST_F(NefWriter, EverySizePatternAndLevelComesBack) {
  std::mt19937 generator(5);
  const auto uniform = [&](int from, int to) {
    return std::uniform_int_distribution<int>(from, to)(generator);
  };
  for (int draw = 0; draw < test_support::draws(60, 2000); ++draw) {
    RawMetadata metadata = d80();
    const char* pattern =
        std::array{"RGGB", "GRBG", "GBRG", "BGGR"}[static_cast<std::size_t>(draw % 4)];
    metadata.cfa = cfa_pattern_from_name(pattern);
    const int black = uniform(0, 1) * uniform(1, 500);
    for (int& of_phase : metadata.black_counts) of_phase = black + (black > 0 ? uniform(0, 20) : 0);
    metadata.exposure_s = 1.0 / uniform(1, 8000);
    metadata.iso = uniform(100, 3200);
    metadata.f_number = 0.1 * uniform(14, 320);
    write(2 * uniform(11, 200), 2 * uniform(11, 100), metadata, static_cast<unsigned>(draw));
    const RawFrame frame = read_raw(path_);
    ASSERT_TRUE(frame.samples == values()) << "draw " << draw;
    EXPECT_EQ(cfa_pattern_name(frame.cfa), pattern);
    for (std::size_t phase = 0; phase < 4; ++phase) {
      EXPECT_EQ(frame.black_counts[phase], metadata.black_counts[phase]) << "draw " << draw;
    }
    EXPECT_NEAR(frame.exposure_s / metadata.exposure_s, 1, 1e-6);
    EXPECT_EQ(frame.iso, metadata.iso);
    EXPECT_NEAR(frame.f_number / metadata.f_number, 1, 1e-6);
  }
}

// StripByteCounts of the last directory, that of the raw picture.
long strip_bytes(const std::vector<std::uint8_t>& file) {
  const std::array<std::uint8_t, 3> tag = {0x01, 0x17, 0x00};
  const auto at = std::find_end(file.begin(), file.end(), tag.begin(), tag.end());
  const int width = at[3] == 3 ? 2 : 4;  // SHORT or LONG
  return std::accumulate(at + 8, at + 8 + width, 0L,
                         [](long n, int byte) { return n << 8 | byte; });
}

// Strips of 1.5, 2 or 3 bytes a sample are taken for uncompressed ones; these images come near the
// first two sizes.
TEST_F(NefWriter, StripsOfMisleadingSizes) {
  constexpr int kSide = 22;
  constexpr long kSamples = (kSide + 4) * (kSide + 3);
  RawMetadata metadata;
  for (int code = 0; code < 4096; ++code) {
    metadata.linearization_table.push_back(static_cast<std::uint16_t>(code));
  }
  int near = 0;
  // A sample that differs much from its prediction takes 22 bits, one that does not takes 5.
  for (int high = 0; high <= kSide * kSide; ++high) {
    std::vector<std::uint16_t> codes(kSide * kSide, 0);
    for (int i = 0; i < high; ++i) {
      codes[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(4094 * (i / 2 % 2));
    }
    write_nef(path_, kSide, kSide, codes, metadata);
    const long bytes = strip_bytes(read_file(path_));
    EXPECT_NE(2 * bytes, 3 * kSamples);
    EXPECT_NE(bytes, 2 * kSamples);
    near += std::abs(2 * bytes - 3 * kSamples) <= 6 || std::abs(bytes - 2 * kSamples) <= 3 ? 1 : 0;
    ASSERT_EQ(read_raw(path_).samples, codes) << high;
  }
  EXPECT_GT(near, 0);
}

TEST_F(NefWriter, ExiftoolReadsEveryField) {
  RawMetadata metadata = d80();
  metadata.cfa = cfa_pattern_from_name("GRBG");
  metadata.black_counts = {61, 60, 63, 62};
  metadata.exposure_s = 0.4;
  metadata.iso = 1600;
  metadata.f_number = 5.6;
  write(64, 48, metadata);
  EXPECT_THAT(
      exiftool_fields(
          path_, {"FileType", "ExifByteOrder", "Make", "Model", "SubIFD:ImageWidth",
                  "SubIFD:ImageHeight", "SubIFD:BitsPerSample", "SubIFD:Compression",
                  "SubIFD:PhotometricInterpretation", "CFAPattern2", "ExposureTime", "ExifIFD:ISO",
                  "FNumber", "MakerNoteVersion", "NEFCompression", "WB_RBLevels", "BlackLevel"}),
      ElementsAre("NEF", "MM", "NIKON CORPORATION", "NIKON D80", "68", "51", "12", "34713", "32803",
                  "1 0 2 1", "0.4", "1600", "5.6", "0210", "1", "1 1 1 1", "240 244 248 252"));
  // Nothing for exiftool to complain about in the structure.
  EXPECT_THAT(exiftool_fields(path_, {"Warning", "Error"}), ElementsAre());
}

// The first directory shows the picture: left half dark, right half at the top of the curve.
TEST_F(NefWriter, ThumbnailIsThePicture) {
  codes_.assign(640 * 480, 0);
  for (std::size_t i = 0; i < codes_.size(); ++i) codes_[i] = i % 640 < 320 ? 0 : 682;
  write_nef(path_, 640, 480, codes_, d80());
  const std::vector<std::string> offset =
      exiftool_fields(path_, {"IFD0:ImageWidth", "IFD0:ImageHeight", "IFD0:StripOffsets"});
  ASSERT_THAT(offset, ElementsAre("160", "120", testing::_));
  const std::vector<std::uint8_t> file = read_file(path_);
  const auto row = static_cast<std::size_t>(std::stoul(offset[2]));
  EXPECT_EQ(file[row + 3 * 79], 0);
  EXPECT_EQ(file[row + 3 * 80], 248);  // 255 sqrt(3880 / 4095)
}

TEST_F(NefWriter, SameInputSameBytes) {
  write(64, 48);
  const std::vector<std::uint8_t> first = read_file(path_);
  write(64, 48);
  EXPECT_EQ(read_file(path_), first);
}

TEST_F(NefWriter, RefusesBrokenPreconditions) {
  const auto refused = [&](const auto& change) {
    RawMetadata metadata = d80();
    change(metadata);
    EXPECT_THROW(write(64, 48, metadata), std::invalid_argument);
  };
  refused([](RawMetadata& m) { m.model = "NIKON D70"; });
  refused([](RawMetadata& m) { m.make = "NIKON"; });
  refused([](RawMetadata& m) { m.white_counts = 4000; });
  refused([](RawMetadata& m) { m.linearization_table.clear(); });
  refused([](RawMetadata& m) { m.linearization_table[7] = m.linearization_table[6]; });
  refused([](RawMetadata& m) { m.exposure_s = 0; });
  EXPECT_THROW(write(63, 48), std::invalid_argument);
  EXPECT_EQ(folder_.entries(), 0);
  EXPECT_THROW(write_nef(folder_ / "nowhere/a.nef", 2, 2, {0, 0, 0, 0}, d80()), InputError);
}

}  // namespace
}  // namespace scattermeter::capture
