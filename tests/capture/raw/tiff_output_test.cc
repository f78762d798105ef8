#include "capture/raw/tiff_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::StartsWith;

void set_grey(TiffOutput& tiff) {
  tiff.set(TIFFTAG_IMAGEWIDTH, 2);
  tiff.set(TIFFTAG_IMAGELENGTH, 1);
  tiff.set(TIFFTAG_BITSPERSAMPLE, 8);
  tiff.set(TIFFTAG_SAMPLESPERPIXEL, 1);
  tiff.set(TIFFTAG_ROWSPERSTRIP, 1);
  tiff.set(TIFFTAG_COMPRESSION, COMPRESSION_NONE);
  tiff.set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
}

TEST(TiffOutput, BlockFollowsTheHeader) {
  const TemporaryFolder folder;
  for (const ByteOrder order : {ByteOrder::kLittleEndian, ByteOrder::kBigEndian}) {
    TiffOutput tiff(folder / "a.tif", order, {'b', 'l', 'o', 'c', 'k', '.'});
    set_grey(tiff);
    tiff.strip({200, 100});
    tiff.end_directory();
    EXPECT_FALSE(std::filesystem::exists(folder / "a.tif"));
    tiff.commit();
    const std::vector<std::uint8_t> bytes = read_file(folder / "a.tif");
    ASSERT_GT(bytes.size(), 16U);
    EXPECT_EQ(bytes[0], order == ByteOrder::kLittleEndian ? 'I' : 'M');
    EXPECT_EQ(std::string(bytes.begin() + 8, bytes.begin() + 14), "block.");
    EXPECT_EQ(bytes[14], 200);
    EXPECT_EQ(bytes[15], 100);
    std::filesystem::remove(folder / "a.tif");
  }
}

TEST(TiffOutput, AFailureIsKeptForTheEnd) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.tif";
  {
    TiffOutput tiff(path, ByteOrder::kLittleEndian, {});
    tiff.strip({1, 2});  // of no size: libtiff needs the width first
    tiff.end_directory();
    try {
      tiff.commit();
      FAIL();
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), StartsWith(path + ": cannot be written: "));
    }
  }
  EXPECT_EQ(folder.entries(), 0);
}

}  // namespace
}  // namespace scattermeter::capture
