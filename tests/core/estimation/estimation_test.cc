#include "core/estimation/estimation.h"

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fixtures/core/cube_estimation.h"

namespace scattermeter {
namespace {

TEST(Estimation, MakesAResultForEachChannelAndRefusesUselessShots) {
  test_support::DipoleCube cube(2);
  cube.show(test_support::kCubeMedium);
  cube.shots[1].observation.channel[2].brightest_snr = 1.0;  // blue of b.dng is dark
  test_support::CubeEstimation run(cube);
  const Estimation& e = run.estimation;
  ASSERT_EQ(e.results.size(), 3U);
  const std::string names = "RGB";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(e.results[i].material, "POM");
    EXPECT_EQ(e.results[i].channel, names[i]);
    EXPECT_EQ(e.results[i].eta_int_over_ext, 1.3);
    EXPECT_EQ(e.results[i].shots, (std::vector<std::string>{"a.dng", "b.dng"}));
    EXPECT_EQ(e.results[i].refused(), i == 2);
  }
  EXPECT_EQ(e.results[2].estimate.reasons.front().substr(0, 23), "b.dng: channel B is dar");
}

TEST(Estimation, WorksOnOpenChannelsAloneAndCountsAllAsSteps) {
  class Counted final : public Progress {
   public:
    void begin(const std::string& what, int total_steps) override {
      name = what;
      steps_expected = total_steps;
    }
    void step() override { ++steps; }
    std::string name;
    int steps_expected = 0;
    std::atomic<int> steps = 0;
  } progress;
  test_support::DipoleCube cube;
  cube.show(test_support::kCubeMedium);
  test_support::CubeEstimation run(cube, {}, {}, &progress);
  Estimation& e = run.estimation;
  e.results[1].estimate.reasons = {"refused"};
  std::vector<int> calls(3, 0);
  e.for_open_channels("a stage", [&](std::size_t i) { ++calls[i]; });
  EXPECT_EQ(calls, (std::vector<int>{1, 0, 1}));
  EXPECT_EQ(progress.name, "a stage");
  EXPECT_EQ(progress.steps_expected, 3);
  EXPECT_EQ(progress.steps, 3);
}

TEST(Estimation, ScaleIsFreeWithoutAResponsivity) {
  Scene scene;
  EXPECT_TRUE(std::isinf(scale_prior(scene).relative_std));
  scene.camera.responsivity = {1.0, 2.0, 3.0};
  scene.camera.responsivity_relative_std = 0.03;
  EXPECT_EQ(scale_prior(scene).relative_std, 0.03);
}

}  // namespace
}  // namespace scattermeter
