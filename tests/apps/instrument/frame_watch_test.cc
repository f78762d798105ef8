#include "apps/instrument/frame_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "apps/simulation/bodies_rig.h"
#include "apps/simulation/virtual_shots.h"
#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(FrameWatch, ExchangedFiltersShowInTheGreenSites) {
  const Rig rig = bodies_rig(480, 1.4, {{"m", plastic()}}, {"cube"});
  const ObjectScenes scenes = bodies_scenes(rig);
  VirtualShots shots(rig, scenes, {.noise = true});
  const capture::ShotSource source = shots.source(1);
  const auto& frames = std::get<capture::FrameSource>(source.open);
  FrameWatch good(rig.scene);
  for (const std::size_t i : source.shot_idxs) good.look(i, frames(i, 0));
  EXPECT_TRUE(good.findings().empty());

  capture::RawFrame other = frames(0, 0);
  other.cfa = cfa_pattern_from_name("GRBG");
  FrameWatch bad(rig.scene);
  bad.look(0, other);
  ASSERT_EQ(bad.findings().size(), 1U);
  const Finding f = bad.findings().front();
  EXPECT_EQ(f.shots, std::vector<std::size_t>{0});
  EXPECT_THAT(f.sentence(), HasSubstr("colour filters exchanged: the two green sites of"));
}

}  // namespace
}  // namespace scattermeter::apps
