#include "apps/watching/running_answer.h"

#include <gtest/gtest.h>

#include "tests/fixtures/apps/body_rig.h"

namespace scattermeter::apps {
namespace {

TEST(RunningAnswer, AnotherShotHelpsAndARefusedChannelIsNotForecast) {
  const Rig rig = body_rig("cube", 2);
  const ObjectScenes objects = bodies_scenes(rig);
  std::vector<ChannelResult> channels(3);
  for (std::size_t c = 0; c < 3; ++c) {
    channels[c].channel = "RGB"[c];
    channels[c].estimate.sigma_s_prime_per_mm.value = plastic()[c].sigma_s_prime_per_mm;
    channels[c].estimate.sigma_a_per_mm.value = plastic()[c].sigma_a_per_mm;
  }
  const auto one = forecast(rig, objects, "plastic", channels, {0});
  const auto both = forecast(rig, objects, "plastic", channels, {0, 1});
  ASSERT_EQ(one.size(), 3U);
  ASSERT_EQ(both.size(), 3U);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(both[c][1], one[c][1]);
  channels[1].estimate.reasons = {"dark"};
  EXPECT_TRUE(forecast(rig, objects, "plastic", channels, {0}).empty());
}

}  // namespace
}  // namespace scattermeter::apps
