#include "capture/raw/tiff_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/raw_reader.h"
#include "core/base/input_error.h"
#include "tests/fixtures/capture/tiff_bytes.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class TiffLayoutTest : public testing::Test {
 protected:
  TiffLayout layout_of(const Bytes& file) const {
    write_file(path_, file);
    return tiff_layout(path_);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "shot.dng";
  TestImage image_ = random_image(64, 48, 12);
};

TEST_F(TiffLayoutTest, JpegInOneStripDecodesAndInSeveralIsRefused) {
  CfaDng one(image_);
  one.shorts(259, {7});
  EXPECT_EQ(layout_of(one.file({lossless_jpeg_rows(image_, 0, 48)})).problem, "");
  EXPECT_EQ(read_raw(path_).samples, image_.codes);

  CfaDng two(image_);
  two.shorts(259, {7});
  two.longs(278, {24});
  const Bytes file =
      two.file({lossless_jpeg_rows(image_, 0, 24), lossless_jpeg_rows(image_, 24, 24)});
  EXPECT_THAT(layout_of(file).problem, HasSubstr("lossless JPEG in 2 strips"));
  EXPECT_THROW(read_raw(path_), InputError);
}

TEST_F(TiffLayoutTest, JpegTilesDecodeAndUncompressedTilesAreRefused) {
  const TestImage left = random_image(32, 48, 12, 2);
  const TestImage right = random_image(32, 48, 12, 3);
  CfaDng dng(image_);
  dng.remove(278);
  dng.longs(322, {32});
  dng.longs(323, {48});
  const Bytes file = dng.file({packed_rows(left, 0, 48), packed_rows(right, 0, 48)}, true);
  EXPECT_THAT(layout_of(file).problem, HasSubstr("2 tiles"));

  dng.shorts(259, {7});
  EXPECT_EQ(
      layout_of(dng.file({lossless_jpeg_rows(left, 0, 48), lossless_jpeg_rows(right, 0, 48)}, true))
          .problem,
      "");
  const RawFrame frame = read_raw(path_);
  for (int y = 0; y < 48; ++y) {
    for (int x = 0; x < 64; ++x) {
      const TestImage& tile = x < 32 ? left : right;
      const int at = 32 * y + x % 32;
      ASSERT_EQ(frame.at(x, y), tile.codes[static_cast<std::size_t>(at)]);
    }
  }
}

TEST_F(TiffLayoutTest, UncompressedStripsMustFollowEachOther) {
  CfaDng dng(image_);
  dng.longs(278, {24});
  const std::vector<Bytes> strips = {packed_rows(image_, 0, 24), packed_rows(image_, 24, 24)};
  EXPECT_EQ(layout_of(dng.file(strips)).problem, "");
  EXPECT_EQ(read_raw(path_).samples, image_.codes);
  EXPECT_THAT(layout_of(dng.file(strips, false, 10)).problem, HasSubstr("not contiguous"));
}

TEST_F(TiffLayoutTest, FewerBytesThanTheImageNeeds) {
  CfaDng dng(image_);
  // Bytes enough follow in the file, but they are not the image's.
  Bytes file = dng.file({packed_rows(image_, 0, 47)});
  file.resize(file.size() + 1000);
  EXPECT_EQ(layout_of(file).problem, "its samples take 4608 bytes, the file holds 4512");
}

TEST_F(TiffLayoutTest, CutFileTellsBothPlaces) {
  CfaDng dng(image_);
  Bytes file = dng.file({packed_rows(image_, 0, 48)});
  const std::size_t whole = file.size();
  file.pop_back();
  EXPECT_EQ(layout_of(file).problem, "the file is truncated: its samples extend to byte " +
                                         std::to_string(whole) + ", the file ends at byte " +
                                         std::to_string(whole - 1));
}

TEST_F(TiffLayoutTest, ActiveAreasCorner) {
  CfaDng dng(image_);
  EXPECT_THAT(layout_of(dng.file({packed_rows(image_, 0, 48)})).active_corner_px,
              ElementsAre(0, 0));
  dng.longs(50829, {7, 5, 48, 64});
  const TiffLayout layout = layout_of(dng.file({packed_rows(image_, 0, 48)}));
  EXPECT_TRUE(layout.is_dng);
  EXPECT_THAT(layout.active_corner_px, ElementsAre(5, 7));
}

TEST_F(TiffLayoutTest, SurvivesWhatIsNoTiffAndLinksInACircle) {
  EXPECT_EQ(layout_of({}).problem, "");
  EXPECT_EQ(layout_of({'I', 'I', 42, 0}).problem, "");
  EXPECT_EQ(layout_of(Bytes(100, 0xff)).problem, "");
  EXPECT_EQ(layout_of({'I', 'I', 42, 0, 0xff, 0xff, 0xff, 0xff}).problem, "");
  // One empty directory whose successor is itself.
  EXPECT_EQ(layout_of({'M', 'M', 0, 42, 0, 0, 0, 8, 0, 0, 0, 0, 0, 8}).problem, "");
  // Every third byte of a good file's directory spoilt in turn: any answer, but an answer.
  CfaDng dng(image_);
  const Bytes good = dng.file({packed_rows(image_, 0, 48)});
  for (std::size_t at = 0; at < 346; at += 3) {
    Bytes bad = good;
    bad[at] = 0xff;
    layout_of(bad);
  }
  EXPECT_THROW(tiff_layout(folder_ / "nowhere"), InputError);
}

}  // namespace
}  // namespace scattermeter::capture
