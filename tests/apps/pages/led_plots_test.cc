#include "apps/pages/led_plots.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

calib::LedCheck mapped_led(const std::string& light, const std::vector<double>& percent) {
  calib::LedCheck led;
  led.light = light;
  calib::LedPlaneMap& map = led.maps.emplace_back();
  map.file = light + ".dng";
  map.columns = 2;
  map.rows = 2;
  map.percent = percent;
  map.std_percent = {0.5, 0.5, 0.5, 0.5};
  return led;
}

TEST(LedPlots, TwoMapsOfAShot) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<PagePlot> plots = led_plane_plots(
      {mapped_led("led1", {0.3, -0.4, none, 0.0}), mapped_led("led2", {6, 0, 0, 0})});
  ASSERT_EQ(plots.size(), 4U);  // percent of both, then deviations of both
  EXPECT_THAT(plots[0].caption, HasSubstr("led1.dng under led1: rms 0.289 %, worst 0.4 %."));
  EXPECT_THAT(plots[1].caption, HasSubstr("led2.dng under led2: rms 3 %, worst 6 %."));
  EXPECT_THAT(plots[2].caption,
              HasSubstr("led1.dng under led1, over its standard deviation: rms 0.577."));
  const PlotSeries& cells = plots[0].plot.series[0];
  EXPECT_EQ(cells.x, (std::vector<double>{0.5, 1.5, 0.5, 1.5}));
  EXPECT_EQ(cells.y, (std::vector<double>{0.5, 0.5, 1.5, 1.5}));
  EXPECT_EQ(cells.value[1], -0.4);
  EXPECT_TRUE(std::isnan(cells.value[2]));
  EXPECT_EQ(plots[2].plot.series[0].value[1], -0.8);
  // One scale for all maps of a kind, without the outermost cells: 0.4 of 0 .. 6, rounded up.
  EXPECT_EQ(plots[0].plot.colours.full_scale, plots[1].plot.colours.full_scale);
  EXPECT_NEAR(plots[0].plot.colours.full_scale, 0.5, 1e-12);
  EXPECT_NEAR(plots[2].plot.colours.full_scale, 5.0, 1e-12);  // at least 3
}

TEST(LedPlots, NoCellNoMap) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(led_plane_plots({mapped_led("led1", {none, none, none, none})}).empty());
  EXPECT_TRUE(led_plane_plots({}).empty());
}

}  // namespace
}  // namespace scattermeter::apps
