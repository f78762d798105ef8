#include "core/estimation/estimate.h"

#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/input_error.h"
#include "core/estimation/material_channel.h"
#include "tests/fixtures/core/cube_scene.h"

namespace scattermeter {
namespace {

using ::testing::HasSubstr;

TEST(Estimate, EveryEstimatorHasANameOfItsOwn) {
  std::set<std::string> names;
  for (const Estimator& e : estimators()) {
    EXPECT_TRUE(names.insert(e.name).second) << e.name;
    EXPECT_EQ(&estimator(e.name), &e);
    EXPECT_NE(std::string(e.description), "");
  }
  EXPECT_EQ(names, (std::set<std::string>{"auto", "dipole", "paper", "transport"}));
  EXPECT_THROW(estimator("guess"), std::invalid_argument);
}

// A shot of the cube in which every sample is as dark as this, with noise of one count.
ObservedShot even_shot(const Scene& scene, const ObjectScenes& objects, const LitObjects& lit,
                       float counts) {
  ObservedShot shot;
  shot.stated = &scene.shots[0];
  shot.pose = test_support::cube_pose();
  shot.seen = see(scene, objects, lit, "cube", shot.pose);
  CfaSamples samples;
  const SampleMap& map = shot.seen->map;
  samples.x0 = map.x0;
  samples.y0 = map.y0;
  samples.width = map.width;
  samples.height = map.height;
  samples.channel_of_phase = {0, 1, 1, 2};
  samples.exposure_s = shot.exposure_s = 0.1;
  const auto n = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  samples.signal_counts.assign(n, counts);
  samples.variance_counts2.assign(n, 1.0F);
  samples.clipped.assign(n, 0);
  shot.observation = observe(samples, map, {1.0, 1.0, 1.0});
  return shot;
}

TEST(Estimate, RefusesShotsThatAreDark) {
  const Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  LitObjects lit(scene, objects, 4.0, 0.0);
  const std::vector<ObservedShot> shots = {even_shot(scene, objects, lit, 0.001F)};
  for (const char* model : {"dipole", "paper", "transport"}) {
    EstimateOptions options;
    options.model = model;
    const std::vector<ChannelResult> results = estimate(scene, lit, shots, options);
    ASSERT_EQ(results.size(), 3U);
    for (const ChannelResult& r : results) {
      EXPECT_TRUE(r.refused());
      EXPECT_EQ(r.model, model);
      EXPECT_THAT(r.estimate.reasons.front(), HasSubstr("a.dng: channel"));
    }
  }
}

TEST(Estimate, EndsWhereItIsCancelled) {
  class Impatient final : public Progress {
   public:
    bool is_cancelled() const override { return true; }
  };
  const Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  LitObjects lit(scene, objects, 4.0, 0.0);
  const std::vector<ObservedShot> shots = {even_shot(scene, objects, lit, 1000.0F)};
  Impatient progress;
  EXPECT_THROW(estimate(scene, lit, shots, {}, &progress), Cancelled);
}

TEST(Estimate, MaterialChannelsFollowTheShots) {
  const Scene scene = test_support::cube_scene();
  const ObjectScenes objects = test_support::cube_objects(scene);
  const LitObjects lit(scene, objects, 4.0, 0.0);
  const std::vector<ObservedShot> shots = {even_shot(scene, objects, lit, 1.0F)};
  EXPECT_EQ(material_channels(scene, shots).size(), 3U);
  const auto blue = material_channels(scene, shots, "B");
  ASSERT_EQ(blue.size(), 1U);
  EXPECT_EQ(blue[0].channel, 2U);
  EXPECT_EQ(blue[0].eta_int_over_ext, 1.3);
  EXPECT_DOUBLE_EQ(patch_size_mm(blue[0]), 4.0);
}

}  // namespace
}  // namespace scattermeter
