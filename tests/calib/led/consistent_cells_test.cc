#include "calib/led/consistent_cells.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

constexpr int kColumns = 9, kRows = 7;

// Cells of one shot and two channels that follow a prediction of 1 within alternating thousandths.
LedScene even_scene() {
  LedScene scene;
  for (int i = 0; i < kColumns * kRows; ++i) {
    for (const int channel : {0, 1}) {
      ShadedCell cell;
      cell.column = i % kColumns;
      cell.row = i / kColumns;
      cell.channel = channel;
      cell.radiance_W_per_mm2_sr = 1.0 + (i % 2 == 0 ? 1e-3 : -1e-3);
      cell.std_W_per_mm2_sr = 1e-3;
      scene.cells.push_back(cell);
    }
  }
  return scene;
}

std::size_t index_of(int column, int row, int channel) {
  return static_cast<std::size_t>(2 * (row * kColumns + column) + channel);
}

std::vector<bool> consistent(const LedScene& scene, const std::vector<bool>& lit) {
  return consistent_cells(scene, lit, std::vector<double>(scene.cells.size(), 1.0), 6.0);
}

TEST(ConsistentCells, AnOutlierTakesItsOtherChannelsAlong) {
  LedScene scene = even_scene();
  const std::vector<bool> all(scene.cells.size(), true);
  EXPECT_EQ(consistent(scene, all), all);
  // The bulk's deviation is 1.4826e-3, the limit 8.9e-3.
  scene.cells[index_of(4, 3, 1)].radiance_W_per_mm2_sr = 0.99;
  std::vector<bool> expected = all;
  expected[index_of(4, 3, 0)] = expected[index_of(4, 3, 1)] = false;
  EXPECT_EQ(consistent(scene, all), expected);
  scene.cells[index_of(4, 3, 1)].radiance_W_per_mm2_sr = 0.992;
  EXPECT_EQ(consistent(scene, all), all);
}

TEST(ConsistentCells, ALargeOneTakesItsNeighbours) {
  LedScene scene = even_scene();
  const std::vector<bool> all(scene.cells.size(), true);
  scene.cells[index_of(4, 3, 0)].radiance_W_per_mm2_sr = 0.5;
  const std::vector<bool> use = consistent(scene, all);
  EXPECT_EQ(std::count(use.begin(), use.end(), false), 18);
  EXPECT_FALSE(use[index_of(3, 2, 1)]);
  EXPECT_TRUE(use[index_of(2, 3, 0)]);
}

TEST(ConsistentCells, WhatIsNotLitTakesNoPart) {
  LedScene scene = even_scene();
  std::vector<bool> lit(scene.cells.size(), true);
  lit[index_of(4, 3, 0)] = false;
  scene.cells[index_of(4, 3, 0)].radiance_W_per_mm2_sr = 1e9;
  EXPECT_EQ(consistent(scene, lit), lit);
}

}  // namespace
}  // namespace scattermeter::calib
