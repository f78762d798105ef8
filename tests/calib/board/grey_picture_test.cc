#include "calib/board/grey_picture.h"

#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::calib {
namespace {

// Colours that are lit differently weigh the same: a field of one radiance is even, and the weight
// of a cell lies in its middle.
TEST(GreyPicture, CellsOfARawWeighTheirColoursAlike) {
  capture::RawFrame frame;
  frame.width_px = 9;  // the odd column is left out
  frame.height_px = 4;
  frame.black_counts = {100, 101, 102, 103};
  const int light[] = {1000, 400, 400, 100};
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 9; ++x) {
      const int phase = 2 * (y % 2) + x % 2;
      const int bright = x < 4 ? 2 : 1;
      frame.samples.push_back(static_cast<std::uint16_t>(100 + phase + bright * light[phase]));
    }
  }
  const GreyPicture picture = grey_picture(frame);
  ASSERT_EQ(picture.width_px, 4);
  ASSERT_EQ(picture.height_px, 2);
  EXPECT_EQ(picture.frame_width_px, 9);
  EXPECT_EQ(picture.px_scale, 2);
  EXPECT_EQ(picture.px_offset, 0.5);
  EXPECT_FLOAT_EQ(picture.grey[0], 2 * picture.grey[2]);
  EXPECT_FLOAT_EQ(picture.grey[4], picture.grey[1]);
}

TEST(GreyPicture, FilesAreTakenByTheirEnding) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.pgm", std::ios::binary) << "P5 3 2 255\n"
                                                    << std::string("\1\2\3\4\5\6");
  const GreyPicture picture = read_grey_picture(folder / "a.pgm", 400);
  EXPECT_EQ(picture.frame_width_px, 3);
  EXPECT_EQ(picture.frame_height_px, 2);
  EXPECT_EQ(picture.grey, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  std::ofstream(folder / "b.png") << "no picture";
  std::ofstream(folder / "c.nef") << "no raw";
  for (const char* bad : {"b.png", "c.nef", "missing.jpg"}) {
    EXPECT_THROW(read_grey_picture(folder / bad, 400), InputError) << bad;
  }
}

// Refused by its head, whatever follows: 900 megapixels that are not there.
TEST(GreyPicture, ClaimsAreHeldToTheLimit) {
  const TemporaryFolder folder;
  const std::string path = folder / "a.pgm";
  std::ofstream(path, std::ios::binary) << "P5 30000 30000 255\n";
  try {
    read_grey_picture(path, 400);
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()),
              path +
                  ": claims 30000 x 30000 pixels, more than the allowed 400 megapixels "
                  "(limits.raw_megapixels of the rig, --max-megapixels without one)");
  }
  std::ofstream(path, std::ios::binary) << "P5 3 2 255\n" << std::string(6, '\1');
  EXPECT_THROW(read_grey_picture(path, 5e-6), InputError);
  EXPECT_EQ(read_grey_picture(path, 6e-6).width_px, 3);
  // By its name a PNG, by its bytes what no camera writes.
  std::ofstream(folder / "a.png") << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\1\1\1\1";
  EXPECT_THROW(read_grey_picture(folder / "a.png", 400), InputError);
}

}  // namespace
}  // namespace scattermeter::calib
