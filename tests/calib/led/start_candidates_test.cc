#include "calib/led/start_candidates.h"

#include <cmath>

#include <gtest/gtest.h>

#include "calib/led/cell_model.h"
#include "tests/fixtures/calib/led_scenes.h"

namespace scattermeter::calib {
namespace {

LedSolve all_cells(const LedScene& scene) {
  LedSolve what;
  what.use_cell.assign(scene.cells.size(), true);
  what.use_highlight.assign(scene.highlights.size(), false);
  return what;
}

LedSceneOptions without_errors() {
  LedSceneOptions options;
  options.rotation_std_rad = options.translation_std_mm = options.center_std_mm = 0.0;
  options.albedo_std = options.highlight_std_px = options.cell_relative_std = 0.0;
  return options;
}

TEST(StartCandidates, VaryTheDistanceWhereShadingAloneTellsIt) {
  const LedScene scene = draw_led_scene(true_led(), without_errors(), 1);
  const Led led = true_led();
  const std::vector<Led> starts = start_candidates(scene, all_cells(scene), led, false);
  ASSERT_EQ(starts.size(), 6U);
  const Eigen::Vector3d center =
      scene.data_center_mm(all_cells(scene).use_cell, all_cells(scene).use_highlight);
  const double distance = (led.position_mm - center).norm();
  const double stretch[] = {1.0, 1.0, 0.75, 0.75, 1.35, 1.35};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR((starts[i].position_mm - center).norm(), stretch[i] * distance, 1e-9) << i;
    const Eigen::Vector3d axis =
        i % 2 == 0 ? led.axis : (center - starts[i].position_mm).normalized().eval();
    EXPECT_TRUE(starts[i].axis.isApprox(axis, 1e-9)) << i;
  }
  EXPECT_EQ(start_candidates(scene, all_cells(scene), led, true).size(), 2U);
}

TEST(StartCandidates, IntensitiesMakeTheMedianCellRight) {
  const LedScene scene = draw_led_scene(true_led(), without_errors(), 1);
  Led led = true_led();
  led.intensity_W_per_sr = {7.0, 1e-3, 0.0};
  const std::vector<Led> starts = start_candidates(scene, all_cells(scene), led, true);
  ASSERT_FALSE(starts.empty());
  // Everything else is the truth: so is then the intensity, to what cells of 5 x 5 points depart
  // from the model's four.
  for (int c = 0; c < 2; ++c) {
    EXPECT_NEAR(starts[0].intensity_W_per_sr[c] / true_led().intensity_W_per_sr[c], 1.0, 1e-4);
  }
}

TEST(StartCandidates, AnAxisThatPointsAwayAndAnLedBehindThePlaneAreLeftOut) {
  const LedScene scene = draw_led_scene(true_led(), without_errors(), 1);
  Led led = true_led();
  led.axis = -led.axis;
  const std::vector<Led> starts = start_candidates(scene, all_cells(scene), led, true);
  ASSERT_EQ(starts.size(), 1U);
  EXPECT_GT(starts[0].axis.dot(true_led().axis), 0.9);
  led = true_led();
  led.position_mm.z() = -80;
  EXPECT_TRUE(start_candidates(scene, all_cells(scene), led, true).empty());
}

TEST(StartCandidates, ExponentsAreNotTooFlat) {
  const LedScene scene = draw_led_scene(true_led(), without_errors(), 1);
  Led led = true_led();
  led.exponent = 0.0;
  for (const Led& start : start_candidates(scene, all_cells(scene), led, true)) {
    EXPECT_EQ(start.exponent, 0.5);
  }
}

}  // namespace
}  // namespace scattermeter::calib
