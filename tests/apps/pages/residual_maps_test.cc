#include "apps/pages/residual_maps.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "apps/pages/packed_integers.h"

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
  EXPECT_NEAR(relative_rms(six_samples()), std::sqrt(5.0 / 10625.0), 1e-9);
  // Most of the differences are at most 1 of the 100 counts of the brightest row in use.
  EXPECT_EQ(difference_scale_percent(six_samples()), 1.0);
}

TEST(ResidualMaps, DataByHand) {
  ShotRows rows = six_samples();
  rows.file = "a.dng";
  const nlohmann::json data = nlohmann::json::parse(residual_map_data({{&rows, 'G'}}, 3, 1.0));
  EXPECT_EQ(data.at("full_scale_percent"), 1.0);
  const nlohmann::json& map = data.at("maps").at(0);
  EXPECT_EQ(map.at("width"), 3);
  EXPECT_EQ(map.at("height"), 2);
  EXPECT_EQ(map.at("rows"), packed_integers({1, 2, 3, 4, 0, 4}, 3));
  const nlohmann::json& shot = data.at("shots").at(0);
  EXPECT_EQ(shot.at("file"), "a.dng");
  EXPECT_EQ(shot.at("channel"), "G");
  EXPECT_EQ(shot.at("map"), 0);
  EXPECT_NEAR(shot.at("rms_percent"), 100.0 * std::sqrt(5.0 / 10625.0), 1e-5);
  // In 0.01 % of 100; what was left out may be brighter.
  EXPECT_EQ(shot.at("observed"), packed_integers({10000, 2500, 700, 32767}, 2));
  // +1 and -2 % in hundredths of the full scale.
  EXPECT_EQ(shot.at("difference"), packed_integers({100, -200, 0, 0}, 2));
  EXPECT_EQ(shot.at("state"), packed_integers({0, 0, 2, 6}, 1));
}

TEST(ResidualMaps, NoRowInUse) {
  ShotRows rows = six_samples();
  rows.state.assign(4, RowState::kNoise);
  EXPECT_EQ(relative_rms(rows), 0.0);
  EXPECT_EQ(difference_scale_percent(rows), 0.0);
  const nlohmann::json data = nlohmann::json::parse(residual_map_data({{&rows, 'R'}}, 3, 0.0));
  EXPECT_EQ(data.at("shots").at(0).at("observed"), packed_integers({0, 0, 0, 0}, 2));
}

// At most as wide as asked for: every second sample.
TEST(ResidualMaps, IsMadeSmaller) {
  auto map = std::make_shared<SampleMap>();
  map->width = 40;
  map->height = 20;
  map->row_of_sample.assign(800, 0);
  ShotRows rows = six_samples();
  rows.map = map;
  const nlohmann::json data =
      nlohmann::json::parse(residual_map_data({{&rows, 'R'}, {&rows, 'G'}}, 25, 1.0));
  ASSERT_EQ(data.at("maps").size(), 1U);  // of both channels
  EXPECT_EQ(data.at("maps").at(0).at("step"), 2);
  EXPECT_EQ(data.at("maps").at(0).at("width"), 20);
  EXPECT_EQ(data.at("maps").at(0).at("height"), 10);
}

// Where not all fit, the shot that departs most in any channel is shown in all.
TEST(ResidualMaps, TheWorstShotsAreShown) {
  ChannelResult red, green;
  red.channel = 'R';
  green.channel = 'G';
  for (const char* file : {"a", "b", "c"}) {
    ShotRows rows = six_samples();
    rows.file = file;
    red.rows.push_back(rows);
    green.rows.push_back(rows);
  }
  green.rows[1].predicted[0] = 80.0F;
  EXPECT_EQ(shots_to_map({&red, &green}, 1'000'000).size(), 6U);
  const std::vector<ChannelShot> one = shots_to_map({&red, &green}, 50);
  ASSERT_EQ(one.size(), 2U);
  EXPECT_EQ(one[0].rows, &red.rows[1]);
  EXPECT_EQ(one[1].rows, &green.rows[1]);
  EXPECT_EQ(one[1].channel, 'G');
}

}  // namespace
}  // namespace scattermeter::apps
