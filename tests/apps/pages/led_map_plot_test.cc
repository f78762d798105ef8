#include "apps/pages/led_map_plot.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

// Places all over the upper hemisphere, every 5 degrees, that know sigma_a to 20 % but for one.
SuggestedShots even_map(LedMap& map) {
  map.object = "cube";
  map.center_mm = {1, 2, 10};
  map.distance_mm = 100;
  map.camera_mm = {1, 2 - 200, 10};  // at the horizon, towards -y
  map.planned_mm = {{1, 2, 300}};    // in the zenith
  for (int zenith = 0; zenith <= 90; zenith += 5) {
    for (int azimuth = 0; azimuth < 360; azimuth += 5) {
      const double z = zenith * std::numbers::pi / 180.0;
      const double a = azimuth * std::numbers::pi / 180.0;
      LedPosition place;
      place.position_mm =
          map.center_mm + 100.0 * Eigen::Vector3d(std::sin(z) * std::cos(a),
                                                  std::sin(z) * std::sin(a), std::cos(z));
      place.alone = 0.4;
      place.joined = 0.2;
      map.positions.push_back(place);
    }
  }
  SuggestedShots other;
  other.material = "POM";
  other.planned = 0.25;
  return other;
}

TEST(LedMapPlot, OneValueAllOver) {
  LedMap map;
  const SuggestedShots other = even_map(map);
  for (const bool joined : {true, false}) {
    const Plot plot = led_map_plot(other, map, joined).plot;
    const PlotSeries& cells = plot.series.at(0);
    // A disc of 90 degrees in cells of 4.
    EXPECT_NEAR(static_cast<double>(cells.value.size()), std::numbers::pi * 90 * 90 / 16, 40);
    for (const double v : cells.value) EXPECT_NEAR(v, joined ? 20.0 : 40.0, 1e-9);
    EXPECT_TRUE(plot.equal_axes && plot.colours.log);
  }
}

TEST(LedMapPlot, MarksWhatStandsThere) {
  LedMap map;
  const SuggestedShots other = even_map(map);
  map.positions[9 * 72 + 18].joined = 0.1;  // 45 degrees from the zenith, towards +y
  const PagePlot page = led_map_plot(other, map, true);
  const auto at = [&](const char* name) {
    for (const PlotSeries& s : page.plot.series) {
      if (s.name == name) return Eigen::Vector2d(s.x.at(0), s.y.at(0));
    }
    return Eigen::Vector2d(999, 999);
  };
  EXPECT_NEAR((at("LEDs planned") - Eigen::Vector2d(0, 0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((at("camera") - Eigen::Vector2d(0, -90)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((at("best") - Eigen::Vector2d(0, 45)).norm(), 0.0, 1e-6);
  EXPECT_THAT(page.caption, HasSubstr("Best: 10 % with the LED at (1, 73, 81) mm; 25 % without."));
  EXPECT_EQ(*page.plot.colours.min,
            *std::min_element(page.plot.series[0].value.begin(), page.plot.series[0].value.end()));
}

// Cells whose nearest place has no value stay empty.
TEST(LedMapPlot, NoValueNoCell) {
  LedMap map;
  const SuggestedShots other = even_map(map);
  for (LedPosition& place : map.positions) {
    if (place.position_mm.x() > map.center_mm.x() + 1e-9) place.joined = std::nan("");
  }
  const PlotSeries cells = led_map_plot(other, map, true).plot.series.at(0);
  EXPECT_GT(cells.x.size(), 500U);
  for (const double x : cells.x) EXPECT_LE(x, 4.0);
}

}  // namespace
}  // namespace scattermeter::apps
