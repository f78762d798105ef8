#include "apps/simulation/virtual_shots.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "apps/rig/open_objects.h"
#include "apps/simulation/bodies_rig.h"
#include "capture/raw/raw_reader.h"
#include "tests/fixtures/apps/small_rig.h"

namespace scattermeter::apps {
namespace {

// The small rig's PE cube under its two LEDs.
class VirtualShotsTest : public ::testing::Test {
 protected:
  VirtualShotsTest() {
    files_.keep_shots("PE_cube");
    rig_ = read_rig(files_.rig());
    scenes_ = open_objects(rig_);
  }

  SmallRig files_;
  Rig rig_;
  ObjectScenes scenes_;
};

TEST_F(VirtualShotsTest, FrameIsWhatIsReadBack) {
  const VirtualShots shots(rig_, scenes_, {.noise = true});
  ASSERT_EQ(shots.size(), 2U);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::string path = files_ / "shot.dng";
    shots.write(i, 5, path);
    const capture::RawFrame read = capture::read_raw(path);
    const capture::RawFrame frame = shots.frame(i, 5);
    EXPECT_TRUE(frame.samples == read.samples);
    EXPECT_EQ(frame.width_px, read.width_px);
    EXPECT_EQ(frame.height_px, read.height_px);
    EXPECT_EQ(frame.cfa, read.cfa);
    EXPECT_EQ(frame.black_counts, read.black_counts);
    EXPECT_EQ(frame.white_counts, read.white_counts);
    EXPECT_EQ(frame.exposure_s, read.exposure_s);
    EXPECT_EQ(frame.iso, read.iso);
    EXPECT_EQ(frame.f_number, read.f_number);
  }
}

TEST_F(VirtualShotsTest, SeedsAndShotsAreStreamsOfTheirOwn) {
  const VirtualShots shots(rig_, scenes_, {.noise = true});
  EXPECT_TRUE(shots.codes(0, 5) == shots.codes(0, 5));
  EXPECT_FALSE(shots.codes(0, 5) == shots.codes(0, 6));
  // A corner that the object does not reach holds noise only: no two shots have it in common.
  const std::vector<std::uint16_t> a = shots.codes(0, 5);
  const std::vector<std::uint16_t> b = shots.codes(1, 5);
  EXPECT_FALSE(std::equal(a.begin(), a.begin() + 100, b.begin()));
}

// The three views of one signal: around the object, over the frame, as samples.
TEST_F(VirtualShotsTest, IdealSamplesAreTheSignal) {
  const VirtualShots shots(rig_, scenes_, {.noise = false});
  const LinearPicture& p = shots.picture(0);
  const std::vector<float> whole = shots.whole_signal_counts(0);
  const int width = rig_.scene.camera.intrinsics.width_px;
  const CfaSamples s = shots.ideal_samples(0, p.x0 - 3, p.y0 - 1, p.width + 2, p.height + 4);
  const capture::RawFrame raw = shots.frame(0, 1);
  double brightest = 0.0;
  std::size_t i = 0;
  for (int y = s.y0; y < s.y0 + s.height; ++y) {
    for (int x = s.x0; x < s.x0 + s.width; ++x, ++i) {
      const float signal = whole[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                 static_cast<std::size_t>(x)];
      ASSERT_EQ(s.signal_counts[i], signal);
      ASSERT_NEAR(raw.at(x, y) - 64.0, static_cast<double>(signal), 0.5001);
      brightest = std::max(brightest, static_cast<double>(signal));
    }
  }
  EXPECT_GT(brightest, 500.0);
  EXPECT_EQ(shots.exposure_s(0), 0.05);
  EXPECT_EQ(shots.responsivity()[1], 2.9e10);
}

// The Monte Carlo of the volume sees about what the dipole does, on a convex body and on one that
// is not, says its error, and gives the same digits again.
TEST(VirtualShots, OfTheVolume) {
  const Medium medium{1.0, 0.02, 1.0};
  const Rig rig = bodies_rig(240, 1.3, {{"M", {medium, medium, medium}}});
  const ObjectScenes scenes = bodies_scenes(rig);
  VirtualShotOptions options{.noise = false};
  const VirtualShots dipole(rig, scenes, options);
  EXPECT_EQ(dipole.monte_carlo_std(), 0.0);
  options.transport.volume = true;
  options.transport.paths = 6400;
  const VirtualShots volume(rig, scenes, options);
  const VirtualShots again(rig, scenes, options);
  EXPECT_GT(volume.monte_carlo_std(), 0.01);
  EXPECT_LT(volume.monte_carlo_std(), 1.0);
  for (std::size_t i = 0; i < volume.size(); ++i) {
    // Of radiance: the exposure is each one's own.
    const auto light = [&](const VirtualShots& shots) {
      double sum = 0.0;
      for (float c : shots.picture(i).counts) sum += c;
      return sum / (shots.exposure_s(i) * shots.responsivity()[1]);
    };
    EXPECT_NEAR(light(volume) / light(dipole), 1.0, 0.25) << rig.scene.shots[i].file;
    EXPECT_EQ(volume.picture(i).counts, again.picture(i).counts);
  }
}

}  // namespace
}  // namespace scattermeter::apps
