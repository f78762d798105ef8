#include "apps/pages/residual_maps.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// A map of 3 x 2 samples: rows 0 1 2, and below them 3, nothing, 3.
ShotRows six_samples() {
  auto map = std::make_shared<SampleMap>();
  map->width = 3;
  map->height = 2;
  map->row_of_sample = {0, 1, 2, 3, -1, 3};
  ShotRows rows;
  rows.map = map;
  const float none = std::numeric_limits<float>::quiet_NaN();
  rows.observed = {100.0F, 25.0F, 7.0F, 400.0F};
  rows.predicted = {99.0F, 27.0F, none, none};
  rows.state = {RowState::kUsed, RowState::kUsed, RowState::kClipped, RowState::kOutlier};
  return rows;
}

TEST(ResidualMaps, NumbersByHand) {
  const ResidualMap map = residual_map(six_samples(), 3, 1.0);
  EXPECT_NEAR(map.rms_relative, std::sqrt(5.0 / 10625.0), 1e-9);
  // Most of the differences are at most 1 of the 100 counts of the brightest row in use.
  EXPECT_EQ(difference_scale_percent(six_samples()), 1.0);
}

TEST(ResidualMaps, ThreePicturesByHand) {
  const Picture p = residual_map(six_samples(), 3, 1.0).picture;
  EXPECT_EQ(p.width_px, 3 * 3 + 2 * 4);
  EXPECT_EQ(p.height_px, 2);
  const PictureColour behind = {28, 30, 34};
  const PictureColour unused = {120, 120, 120};
  // Observed: grey by brightness, clipped red, left out orange.
  EXPECT_EQ(p.at(0, 0), grey_colour(1.0));
  EXPECT_EQ(p.at(1, 0), grey_colour(0.25));
  EXPECT_EQ(p.at(2, 0), (PictureColour{213, 0, 50}));
  EXPECT_EQ(p.at(0, 1), (PictureColour{230, 159, 0}));
  EXPECT_EQ(p.at(1, 1), behind);
  // Model.
  EXPECT_EQ(p.at(7, 0), grey_colour(0.99));
  EXPECT_EQ(p.at(8, 0), grey_colour(0.27));
  EXPECT_EQ(p.at(9, 0), unused);
  EXPECT_EQ(p.at(8, 1), behind);
  // Difference: +1 and -2 of a full scale of 1.
  EXPECT_EQ(p.at(14, 0), difference_colour(1.0));
  EXPECT_EQ(p.at(15, 0), difference_colour(-1.0));
  EXPECT_EQ(p.at(16, 0), unused);
  EXPECT_EQ(p.at(14, 1), unused);
}

TEST(ResidualMaps, NoRowInUse) {
  ShotRows rows = six_samples();
  rows.state.assign(4, RowState::kNoise);
  const ResidualMap map = residual_map(rows, 3, 0.0);
  EXPECT_EQ(map.rms_relative, 0.0);
  EXPECT_EQ(difference_scale_percent(rows), 0.0);
  EXPECT_EQ(map.picture.at(14, 0), (PictureColour{120, 120, 120}));
}

// At most as wide as asked for: every second sample.
TEST(ResidualMaps, IsMadeSmaller) {
  auto map = std::make_shared<SampleMap>();
  map->width = 40;
  map->height = 20;
  map->row_of_sample.assign(800, 0);
  ShotRows rows = six_samples();
  rows.map = map;
  const Picture p = residual_map(rows, 25, 1.0).picture;
  EXPECT_EQ(p.width_px, 3 * 20 + 2 * 4);
  EXPECT_EQ(p.height_px, 10);
}

// As on a page: another shot of larger differences sets the scale.
TEST(ResidualMaps, AScaleForAll) {
  const Picture p = residual_map(six_samples(), 3, 4.0).picture;
  EXPECT_EQ(p.at(14, 0), difference_colour(0.26));  // a quarter, in steps of a fiftieth
  EXPECT_EQ(p.at(15, 0), difference_colour(-0.5));
}

}  // namespace
}  // namespace scattermeter::apps
