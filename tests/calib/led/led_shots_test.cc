#include "calib/led/led_shots.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calib/led/cell_model.h"
#include "core/base/input_error.h"
#include "tests/fixtures/calib/led_bench.h"

namespace scattermeter::calib {
namespace {

using ::testing::HasSubstr;

TEST(LedShots, HighlightsAndCellsAreThoseOfTheLed) {
  const LedBench bench;
  const LedShots shots = read_led_shots(bench.input, "led", bench.frames());
  EXPECT_TRUE(shots.notes.empty()) << shots.notes.front();
  ASSERT_EQ(shots.scene.views.size(), 1U);
  ASSERT_EQ(shots.scene.highlights.size(), 3U);
  EXPECT_EQ(shots.highlight_names[1], "spheres.dng sphere 2");
  const Lens lens(bench.input.intrinsics);
  for (const SeenHighlight& h : shots.scene.highlights) {
    const Eigen::Vector2d expected = highlight_px(lens, shots.scene.views[0].camera_from_world,
                                                  shots.scene.spheres[h.sphere], bench.truth);
    EXPECT_LT((h.image_px - expected).norm(), 0.05) << h.sphere;
  }
  ASSERT_GT(shots.scene.cells.size(), 100U);
  for (const ShadedCell& cell : shots.scene.cells) {
    EXPECT_NEAR(cell.radiance_W_per_mm2_sr / cell_radiance(shots.scene, cell, bench.truth), 1.0,
                3e-3);
  }
  ASSERT_EQ(shots.grids.size(), 1U);
  EXPECT_EQ(shots.grids[0].file, "plane.dng");
  EXPECT_EQ(shots.scene.ambient_subtracted, std::vector<bool>{false});
}

TEST(LedShots, ThePlaneWithTheLedOffIsSubtracted) {
  LedBench bench(true);
  bench.ambient_radiance_W_per_mm2_sr = 1e-7;
  const LedShots shots = read_led_shots(bench.input, "led", bench.frames());
  EXPECT_EQ(shots.scene.ambient_subtracted, std::vector<bool>{true});
  ASSERT_FALSE(shots.scene.cells.empty());
  for (const ShadedCell& cell : shots.scene.cells) {
    EXPECT_NEAR(cell.radiance_W_per_mm2_sr / cell_radiance(shots.scene, cell, bench.truth), 1.0,
                5e-3);
  }
}

TEST(LedShots, RefusesAnUnknownLightAndAPlaneOutOfView) {
  LedBench bench;
  EXPECT_THROW(read_led_shots(bench.input, "other", bench.frames()), InputError);
  bench.input.leds.clear();
  EXPECT_THROW(read_led_shots(bench.input, "led", bench.frames()), InputError);
  LedBench away;
  away.input.shots.planes[0].origin_mm.x() = 500;
  try {
    read_led_shots(away.input, "led", away.frames());
    FAIL() << "accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("rig.yaml:4"));
    EXPECT_THAT(e.what(), HasSubstr("plane 1 is out of view"));
  }
}

}  // namespace
}  // namespace scattermeter::calib
