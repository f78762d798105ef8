#include "apps/looks/frame_watch.h"

#include <algorithm>
#include <cstdint>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

class FrameWatchOfACube : public ::testing::Test {
 protected:
  FrameWatchOfACube()
      : rig_(bodies_rig(480, 1.4, {{"m", plastic()}}, {"cube"})),
        scenes_(bodies_scenes(rig_)),
        shots_(rig_, scenes_, {.noise = true}),
        source_(shots_.source(1)) {}
  capture::RawFrame frame(std::size_t shot_idx) const {
    return std::get<capture::FrameSource>(source_.open)(shot_idx, 0);
  }
  // With this share of hot pixels.
  capture::RawFrame heated(double share) const {
    capture::RawFrame out = frame(0);
    std::mt19937_64 random(1);
    for (std::uint16_t& sample : out.samples) {
      if (std::uniform_real_distribution<double>()(random) < share) {
        sample = static_cast<std::uint16_t>(std::min(sample + 1000.0, out.white_counts));
      }
    }
    return out;
  }

  Rig rig_;
  ObjectScenes scenes_;
  VirtualShots shots_;
  capture::ShotSource source_;
};

TEST_F(FrameWatchOfACube, GoodShotsHaveNoFindings) {
  FrameWatch good(rig_.scene);
  for (const std::size_t i : source_.shot_idxs) good.look(i, frame(i));
  EXPECT_TRUE(good.findings().empty());
}

TEST_F(FrameWatchOfACube, ManyHotPixelsAreToldFromFew) {
  FrameWatch few(rig_.scene), many(rig_.scene);
  few.look(0, heated(0.003));
  EXPECT_TRUE(few.findings().empty());
  many.look(0, frame(0));
  many.look(1, heated(0.03));
  ASSERT_EQ(many.findings().size(), 1U);
  EXPECT_EQ(many.findings().front().shots, std::vector<std::size_t>{1});
  EXPECT_THAT(many.findings().front().sentence(), HasSubstr("hot pixels: 2."));
}

TEST_F(FrameWatchOfACube, ExchangedFiltersShowInTheGreenSites) {
  capture::RawFrame other = frame(0);
  other.cfa = cfa_pattern_from_name("GRBG");
  FrameWatch bad(rig_.scene);
  bad.look(0, other);
  ASSERT_EQ(bad.findings().size(), 1U);
  const Finding f = bad.findings().front();
  EXPECT_EQ(f.shots, std::vector<std::size_t>{0});
  EXPECT_THAT(f.sentence(), HasSubstr("colour filters exchanged: the two green sites of"));
}

TEST_F(FrameWatchOfACube, MissingRowsAreADamagedFile) {
  capture::RawFrame damaged = frame(0);
  const auto from = static_cast<std::ptrdiff_t>(damaged.samples.size() * 2 / 3);
  std::fill(damaged.samples.begin() + from, damaged.samples.end(), std::uint16_t{0});
  FrameWatch bad(rig_.scene);
  bad.look(0, damaged);
  ASSERT_EQ(bad.findings().size(), 1U);
  EXPECT_THAT(bad.findings().front().sentence(), HasSubstr("damaged file: 33 % of the rows"));
  damaged.black_counts.fill(0.0);
  FrameWatch black_is_zero(rig_.scene);
  black_is_zero.look(0, damaged);
  EXPECT_TRUE(black_is_zero.findings().empty());
}

}  // namespace
}  // namespace scattermeter::apps
