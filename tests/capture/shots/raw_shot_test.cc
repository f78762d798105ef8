#include "capture/shots/raw_shot.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/raw/dng_writer.h"
#include "core/base/input_error.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::capture {
namespace {

using ::testing::HasSubstr;

class RawShotTest : public ::testing::Test {
 protected:
  RawShotTest() {
    scene_.source = "rig.yaml";
    scene_.camera.model = "NIKON D80";
    scene_.camera.intrinsics.width_px = 64;
    scene_.camera.intrinsics.height_px = 48;
    for (std::size_t i = 0; i < codes_.size(); ++i) {
      codes_[i] = static_cast<std::uint16_t>(100 + i % 1000);
    }
    write_dng(path_, 64, 48, codes_, {});
  }

  // Why the file is refused; "" where it is not.
  std::string refusal(const ShotDecoding& decoding = {}) const {
    try {
      open_shot(scene_, decoding, path_);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  }

  Scene scene_;
  TemporaryFolder folder_;
  std::string path_ = folder_ / "a.dng";
  std::vector<std::uint16_t> codes_ = std::vector<std::uint16_t>(64 * 48);
};

TEST_F(RawShotTest, OpensWhatTheSceneSays) {
  const RawFrame frame = open_shot(scene_, {}, path_);
  EXPECT_EQ(frame.samples, codes_);
  EXPECT_NEAR(frame.exposure_s, 0.1, 1e-8);
  scene_.camera.model.clear();  // any
  EXPECT_EQ(refusal(), "");
}

TEST_F(RawShotTest, RefusesAnotherCamera) {
  scene_.camera.model = "Canon EOS 5D";
  EXPECT_THAT(refusal(), HasSubstr("a.dng: camera.model"));
  EXPECT_THAT(refusal(), HasSubstr("Canon EOS 5D"));
  EXPECT_THAT(refusal(), HasSubstr("D80"));
}

TEST_F(RawShotTest, RefusesAnotherSize) {
  scene_.camera.intrinsics.height_px = 50;
  EXPECT_THAT(refusal(), HasSubstr("64 x 48 samples, but the rig rig.yaml says 64 x 50"));
}

TEST_F(RawShotTest, RefusesWhatClaimsTooMuch) {
  EXPECT_EQ(refusal({nullptr, "", 0.01}), "");
  EXPECT_THAT(refusal({nullptr, "", 0.002}), HasSubstr("a.dng"));
}

}  // namespace
}  // namespace scattermeter::capture
