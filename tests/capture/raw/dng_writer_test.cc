#include "capture/raw/dng_writer.h"

#include <csignal>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "capture/raw/raw_reader.h"
#include "capture/raw/tone_curve.h"
#include "core/base/input_error.h"
#include "tests/fixtures/capture/process.h"
#include "tests/fixtures/capture/tiff_bytes.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

class DngWriter : public testing::Test {
 protected:
  void write(const RawMetadata& metadata) const { write_dng(path_, 64, 48, codes_, metadata); }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "shot.dng";
  std::vector<std::uint16_t> codes_ = random_image(64, 48, 12).codes;
};

TEST_F(DngWriter, ExiftoolReadsEveryField) {
  RawMetadata metadata;
  metadata.cfa = cfa_pattern_from_name("GBRG");
  metadata.black_counts = {60, 60, 60, 60};
  metadata.white_counts = 4000;
  metadata.exposure_s = 0.4;
  metadata.iso = 1600;
  metadata.f_number = 5.6;
  write(metadata);
  EXPECT_THAT(exiftool_fields(path_, {"FileType", "ImageWidth", "ImageHeight", "BitsPerSample",
                                      "Compression", "PhotometricInterpretation", "Make", "Model",
                                      "Orientation", "ExposureTime", "ISO", "FNumber", "DNGVersion",
                                      "UniqueCameraModel", "BlackLevel", "WhiteLevel",
                                      "CFAPattern2", "CalibrationIlluminant1", "AsShotNeutral"}),
              ElementsAre("DNG", "64", "48", "12", "1", "32803", "NIKON CORPORATION", "NIKON D80",
                          "1", "0.4", "1600", "5.6", "1 4 0 0", "NIKON D80", "60", "4000",
                          "1 2 0 1", "21", "1 1 1"));
  EXPECT_THAT(exiftool_fields(path_, {"BlackLevelRepeatDim", "LinearizationTable"}), ElementsAre());
  // Nothing for exiftool to complain about in the structure.
  EXPECT_THAT(exiftool_fields(path_, {"Warning", "Error"}), ElementsAre());
}

TEST_F(DngWriter, BlackOfEveryPhaseAndACurve) {
  RawMetadata metadata;
  metadata.black_counts = {60, 61, 62, 63};
  metadata.linearization_table = {0, 3, 9, 1000};
  std::fill(codes_.begin(), codes_.end(), std::uint16_t{3});
  write(metadata);
  EXPECT_THAT(exiftool_fields(path_, {"BlackLevelRepeatDim", "BlackLevel"}),
              ElementsAre("2 2", "60 61 62 63"));
  EXPECT_THAT(exiftool_fields(path_, {"b", "LinearizationTable"}), ElementsAre("0 3 9 1000"));
  EXPECT_EQ(read_raw(path_).at(5, 5), 1000);
}

TEST_F(DngWriter, ExposureTimesAreTheBestRational) {
  // exiftool prints the quotient to ten digits.
  struct Case {
    double exposure_s;
    const char* read;
  };
  for (const Case& c : {Case{1.0 / 8000, "0.000125"}, Case{1.0 / 3, "0.3333333333"}, Case{30, "30"},
                        Case{123.456, "123.456"}, Case{0.1, "0.1"}, Case{1.0 / 7, "0.1428571429"},
                        Case{3600, "3600"}}) {
    RawMetadata metadata;
    metadata.exposure_s = c.exposure_s;
    write(metadata);
    EXPECT_THAT(exiftool_fields(path_, {"ExposureTime"}), ElementsAre(c.read));
    EXPECT_NEAR(read_raw(path_).exposure_s / c.exposure_s, 1, 1e-7);  // LibRaw keeps a float
  }
}

TEST_F(DngWriter, ReaderGetsBackWhatWasWritten) {
  for (const bool curved : {false, true}) {
    RawMetadata metadata;
    metadata.cfa = cfa_pattern_from_name("BGGR");
    if (curved) metadata.linearization_table = nef_lossy_curve();
    std::vector<std::uint16_t> values = codes_;
    if (curved) {
      for (std::size_t i = 0; i < codes_.size(); ++i) {
        codes_[i] = static_cast<std::uint16_t>(codes_[i] % 683);
        values[i] = metadata.linearization_table[codes_[i]];
      }
    }
    write(metadata);
    const RawFrame frame = read_raw(path_);
    EXPECT_EQ(frame.samples, values);
    EXPECT_EQ(cfa_pattern_name(frame.cfa), "BGGR");
    EXPECT_EQ(frame.curve_levels, metadata.linearization_table);
    EXPECT_EQ(frame.white_counts, 4095);
    EXPECT_EQ(frame.exposure_s, 0.1);
    EXPECT_EQ(frame.iso, 100);
    EXPECT_EQ(frame.f_number, 8);
  }
}

TEST_F(DngWriter, SameInputSameBytes) {
  write({});
  write_dng(folder_ / "again.dng", 64, 48, codes_, {});
  EXPECT_EQ(read_file(path_), read_file(folder_ / "again.dng"));
}

TEST_F(DngWriter, SmallestFrameThatLibRawTakes) {
  write_dng(path_, 22, 22, std::vector<std::uint16_t>(22 * 22, 9), {});
  EXPECT_EQ(read_raw(path_).samples, std::vector<std::uint16_t>(22 * 22, 9));
  write_dng(path_, 20, 20, std::vector<std::uint16_t>(20 * 20, 9), {});
  EXPECT_THROW(read_raw(path_), InputError);
}

TEST_F(DngWriter, RefusesBrokenPreconditions) {
  const auto refused = [&](const auto& change) {
    RawMetadata metadata;
    change(metadata);
    EXPECT_THROW(write(metadata), std::invalid_argument);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refused([](RawMetadata& m) { m.make.clear(); });
  refused([](RawMetadata& m) { m.model.clear(); });
  refused([](RawMetadata& m) { m.black_counts[2] = -1; });
  refused([](RawMetadata& m) { m.black_counts[2] = 4095; });
  refused([](RawMetadata& m) { m.white_counts = 0; });
  refused([](RawMetadata& m) { m.white_counts = 65536; });
  refused([](RawMetadata& m) { m.exposure_s = 0; });
  refused([&](RawMetadata& m) { m.exposure_s = nan; });
  refused([](RawMetadata& m) { m.iso = 0; });
  refused([](RawMetadata& m) { m.iso = 65535; });
  refused([](RawMetadata& m) { m.f_number = -8; });
  refused([](RawMetadata& m) { m.linearization_table.assign(4097, 1); });
  refused([](RawMetadata& m) { m.linearization_table.assign(100, 1); });  // codes reach 4095
  EXPECT_THROW(write_dng(path_, 64, 47, codes_, {}), std::invalid_argument);
  EXPECT_THROW(write_dng(path_, 0, 48, {}, {}), std::invalid_argument);
  EXPECT_THROW(write_dng(path_, 63, 48, std::vector<std::uint16_t>(63 * 48), {}),
               std::invalid_argument);
  codes_[100] = 4096;
  EXPECT_THROW(write({}), std::invalid_argument);
  EXPECT_EQ(folder_.entries(), 0);
}

TEST_F(DngWriter, FolderThatIsNotThere) {
  const std::string lost = folder_ / "nowhere/shot.dng";
  try {
    write_dng(lost, 64, 48, codes_, {});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), StartsWith(lost));
  }
}

// A limit on the size of files stops the write half-way, as a full disk does.
TEST_F(DngWriter, DiskFullLeavesTheOldFileAndNothingElse) {
  write({});
  const std::vector<std::uint8_t> before = read_file(path_);
  rlimit old_limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old_limit), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small = {4096, old_limit.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  std::string message;
  testing::internal::CaptureStderr();
  try {
    write({});
  } catch (const InputError& error) {
    message = error.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &old_limit);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(message, StartsWith(path_ + ": cannot be written"));
  EXPECT_EQ(read_file(path_), before);
  EXPECT_EQ(folder_.entries(), 1);
}

}  // namespace
}  // namespace scattermeter::capture
