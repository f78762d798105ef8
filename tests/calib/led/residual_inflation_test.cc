#include "calib/led/residual_inflation.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

TEST(ResidualInflation, IsOneUpToThreeDeviations) {
  // 203 residuals, 3 parameters: 200 degrees of freedom, deviation of the ratio 0.1.
  EXPECT_EQ(residual_inflation(200.0, 203.0, 3.0), 1.0);
  EXPECT_EQ(residual_inflation(120.0, 203.0, 3.0), 1.0);
  EXPECT_EQ(residual_inflation(259.0, 203.0, 3.0), 1.0);
  EXPECT_DOUBLE_EQ(residual_inflation(262.0, 203.0, 3.0), 1.31);
  EXPECT_EQ(residual_inflation(1e6, 3.5, 3.0), 1.0);
}

// Residuals of one deviation, all of one sign within blocks of 3 x 3 cells and of the other sign
// in the next: alone they are noise, as means they are nine times too large in variance.
TEST(ResidualInflation, BlocksShowWhatNeighboursShare) {
  LedScene scene;
  std::vector<double> predicted;
  for (int i = 0; i < 36 * 36; ++i) {
    ShadedCell cell;
    cell.column = i % 36;
    cell.row = i / 36;
    cell.std_W_per_mm2_sr = 0.25;
    const double sign = (cell.column / 3 + cell.row / 3) % 2 == 0 ? 1.0 : -1.0;
    cell.radiance_W_per_mm2_sr = 5.0 + sign * 0.25;
    scene.cells.push_back(cell);
    predicted.push_back(5.0);
  }
  std::vector<bool> use(scene.cells.size(), true);
  // 144 blocks of squared sum 9 each.
  EXPECT_NEAR(cell_inflation(scene, predicted, use, 0.0), 9.0, 1e-12);
  // The same signs from cell to cell cancel in the blocks.
  for (ShadedCell& cell : scene.cells) {
    cell.radiance_W_per_mm2_sr = 5.0 + ((cell.column + cell.row) % 2 == 0 ? 0.25 : -0.25);
  }
  EXPECT_EQ(cell_inflation(scene, predicted, use, 0.0), 1.0);
  // Cells that are not in use do not count.
  scene.cells[7].radiance_W_per_mm2_sr = 1e6;
  use[7] = false;
  EXPECT_EQ(cell_inflation(scene, predicted, use, 0.0), 1.0);
}

}  // namespace
}  // namespace scattermeter::calib
