#include "calib/led/plane_map.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scattermeter::calib {
namespace {

ShadedCell cell_at(std::size_t shot, int column, int row, int channel) {
  ShadedCell cell;
  cell.shot = shot;
  cell.column = column;
  cell.row = row;
  cell.channel = channel;
  cell.radiance_W_per_mm2_sr = 2.0;
  cell.std_W_per_mm2_sr = 0.02;
  return cell;
}

TEST(PlaneMap, MeansOfTheChannelsOfOneShot) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<ShadedCell> cells = {cell_at(0, 0, 1, 0), cell_at(1, 1, 0, 0),
                                         cell_at(1, 1, 0, 1), cell_at(1, 0, 1, 2),
                                         cell_at(1, 1, 1, 2)};
  const LedPlaneMap map = plane_map({"b.dng", 1, 2, 2}, cells, {9.0, 0.01, 0.03, -0.05, none});
  EXPECT_EQ(map.file, "b.dng");
  ASSERT_EQ(map.percent.size(), 4U);
  EXPECT_TRUE(std::isnan(map.percent[0]));
  EXPECT_NEAR(map.percent[1], 2.0, 1e-12);
  EXPECT_NEAR(map.percent[2], -5.0, 1e-12);
  EXPECT_TRUE(std::isnan(map.percent[3]));
  // 1 % of noise on each channel, of what was predicted.
  EXPECT_NEAR(map.std_percent[1], 0.5 * std::hypot(1.01, 1.03), 1e-12);
  EXPECT_NEAR(map.std_percent[2], 0.95, 1e-12);
}

}  // namespace
}  // namespace scattermeter::calib
