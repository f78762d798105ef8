// What capture/raw/raw_reader.cc refuses, and that it says why without printing.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/raw_reader.h"
#include "core/base/input_error.h"
#include "tests/fixtures/capture/tiff_bytes.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class RawReaderRefusal : public testing::Test {
 protected:
  // The message read_raw() throws, or "accepted"; whatever it prints is a failure.
  static std::string refusal(const std::string& path, double max_megapixels = 400) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    std::string message = "accepted";
    try {
      read_raw(path, max_megapixels);
    } catch (const InputError& error) {
      message = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << path;
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << path;
    return message;
  }

  std::string refusal_of(const Bytes& file, double max_megapixels = 400) const {
    write_file(path_, file);
    return refusal(path_, max_megapixels);
  }

  TemporaryFolder folder_;
  std::string path_ = folder_ / "shot.dng";
  TestImage image_ = random_image(64, 48, 12);
  Bytes samples_ = packed_rows(image_, 0, 48);
};

TEST_F(RawReaderRefusal, WhatIsNoRawFile) {
  const std::string missing = folder_ / "nowhere.dng";
  EXPECT_EQ(refusal(missing), missing + ": no such file");
  EXPECT_THAT(refusal(folder_.path()), AllOf(StartsWith(folder_.path()), HasSubstr("folder")));
  EXPECT_THAT(refusal_of({}), AllOf(StartsWith(path_), HasSubstr("empty")));
  EXPECT_THAT(refusal_of(Bytes(4096, 0)), AllOf(StartsWith(path_), HasSubstr("no raw file")));
  const std::string text = "Dear diary, today I photographed a cube.\n";
  EXPECT_THAT(refusal_of(Bytes(text.begin(), text.end())),
              AllOf(StartsWith(path_), HasSubstr("no raw file")));
}

TEST_F(RawReaderRefusal, PicturesAreNamedAsSuch) {
  const Bytes jpeg = {0xff, 0xd8, 0xff, 0xe0, 0, 16, 'J', 'F', 'I', 'F',
                      0,    1,    1,    0,    0, 1,  0,   1,   0,   0};
  EXPECT_EQ(refusal_of(jpeg), path_ +
                                  ": is a JPEG picture, a raw file is needed: set the camera to "
                                  "raw (NEF, CR2, DNG ...) and give these files");
  EXPECT_THAT(refusal_of({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13}),
              HasSubstr("is a PNG picture"));
}

// LibRaw can overrun a buffer on the names in such files (parseHassyModel()).
TEST_F(RawReaderRefusal, MakeThatLibRawIsNotSafeWith) {
  constexpr unsigned kMake = 271;
  constexpr unsigned kModel = 272;
  constexpr unsigned kUniqueCameraModel = 50708;
  const auto refused = AllOf(StartsWith(path_), HasSubstr("Hasselblad"));
  CfaDng dng(image_);
  EXPECT_EQ(refusal_of(dng.file({samples_})), "accepted");
  CfaDng unique(image_);
  unique.ascii(kUniqueCameraModel, "HASSELBLAD L1D-20c");
  EXPECT_THAT(refusal_of(unique.file({samples_})), refused);
  dng.ascii(kMake, "Hasselblad");
  EXPECT_THAT(refusal_of(dng.file({samples_})), refused);
  dng.ascii(kModel, std::string(40, 'x') + '-' + std::string(22, 'x'));
  EXPECT_THAT(refusal_of(dng.file({samples_})), refused);
}

TEST_F(RawReaderRefusal, WhatHasNoBayerPattern) {
  const auto with = [&](const auto& change) {
    CfaDng dng(image_);
    change(dng);
    return refusal_of(dng.file({samples_}));
  };
  EXPECT_EQ(with([](CfaDng&) {}), "accepted");
  const auto no_bayer = AllOf(StartsWith(path_), HasSubstr("no 2 x 2 red-green-blue"));
  EXPECT_THAT(with([](CfaDng& dng) {
                dng.remove(33421);
                dng.remove(33422);
              }),
              no_bayer);
  EXPECT_THAT(with([](CfaDng& dng) { dng.shorts(262, {34892}); }), no_bayer);
  EXPECT_THAT(with([](CfaDng& dng) { dng.bytes(33422, {0, 0, 1, 2}); }), no_bayer);
  EXPECT_THAT(with([](CfaDng& dng) { dng.bytes(33422, {0, 1, 3, 2}); }), no_bayer);
  EXPECT_THAT(with([](CfaDng& dng) {
                dng.shorts(33421, {6, 6});  // X-Trans
                dng.bytes(33422, {1, 2, 1, 1, 0, 1, 0, 1, 0, 2, 1, 2, 1, 2, 1, 1, 0, 1,
                                  1, 0, 1, 1, 2, 1, 2, 1, 2, 0, 1, 0, 1, 0, 1, 1, 2, 1});
              }),
              no_bayer);
  CfaDng linear(image_);
  linear.shorts(262, {34892});
  linear.shorts(277, {3});
  linear.shorts(258, {16, 16, 16});
  EXPECT_THAT(refusal_of(linear.file({Bytes(64 * 48 * 6)})), no_bayer);
}

TEST_F(RawReaderRefusal, MoreMegapixelsThanAllowed) {
  const Bytes file = CfaDng(image_).file({samples_});
  EXPECT_EQ(refusal_of(file, 0.003072), "accepted");  // 64 * 48 samples
  EXPECT_EQ(refusal_of(file, 0.003),
            path_ +
                ": claims 64 x 48 samples, more than the allowed 0.003 megapixels "
                "(limits.raw_megapixels of the rig)");
  // The claim alone: a few kilobytes that ask for 7.2 GB.
  CfaDng dng(image_);
  dng.longs(256, {60000});
  dng.longs(257, {60000});
  EXPECT_THAT(refusal_of(dng.file({samples_})), HasSubstr("60000 x 60000"));
}

TEST_F(RawReaderRefusal, EveryLengthOfACutFile) {
  const TestImage wide = random_image(64, 48, 16);
  CfaDng packed(image_);
  CfaDng unpacked(wide);
  CfaDng jpeg(image_);
  jpeg.shorts(259, {7});
  for (const Bytes& file : {packed.file({samples_}), unpacked.file({packed_rows(wide, 0, 48)}),
                            jpeg.file({lossless_jpeg_rows(image_, 0, 48)})}) {
    ASSERT_EQ(refusal_of(file), "accepted");
    for (std::size_t length = 0; length < file.size();
         length += length + 40 < file.size() ? 37 : 1) {
      const Bytes cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length));
      ASSERT_THAT(refusal_of(cut), StartsWith(path_))
          << length << " of " << file.size() << " bytes";
    }
  }
}

TEST_F(RawReaderRefusal, CutFileSaysSo) {
  Bytes file = CfaDng(image_).file({samples_});
  file.resize(file.size() - 1000);
  EXPECT_THAT(refusal_of(file), HasSubstr("truncated"));
}

// Samples that leave their bit depth are the damage that the decoder sees and counts, but goes on.
// (Flipped bits that decode to something possible cannot be told: the stream has no checksum.)
TEST_F(RawReaderRefusal, DamagedLosslessJpeg) {
  TestImage spoilt = image_;
  spoilt.codes[1000] = 4096;
  CfaDng dng(image_);
  dng.shorts(259, {7});
  EXPECT_THAT(refusal_of(dng.file({lossless_jpeg_rows(spoilt, 0, 48)})),
              AllOf(StartsWith(path_), HasSubstr("damaged")));
}

}  // namespace
}  // namespace scattermeter::capture
