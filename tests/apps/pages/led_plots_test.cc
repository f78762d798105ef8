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

// Two cells, seen at 0 and at 45 degrees from the axis of an LED of exponent 1, the second one 2 %
// brighter than the fit, and two highlights, one of them left out.
TEST(LedPlots, FitAgainstWhatWasMeasured) {
  calib::LedCalibration c;
  c.light = "led1";
  c.fit.led.position_mm = {0, 0, 50};
  c.fit.highlight_residuals_px = {{0.25, -0.5}, {7.0, 0.0}};
  c.fit.highlight_used = {true, false};
  c.fit.cell_residuals = {0.0, 0.02};
  c.fit.cell_used = {true, true};
  c.shots.grids = {{"plane.dng", 0, 2, 1}};
  c.shots.scene.planes.resize(1);
  for (const int column : {0, 1}) {
    calib::ShadedCell& cell = c.shots.scene.cells.emplace_back();
    cell.column = column;
    cell.radiance_W_per_mm2_sr = 1.0;
    cell.std_W_per_mm2_sr = 0.001;
  }
  c.shots.scene.planes[0].origin_mm = {0, 0, 0};
  c.shots.scene.cells[1].on_plane_mm = {50.0, 0.0};
  const std::vector<PagePlot> plots = led_fit_plots(c);
  ASSERT_EQ(plots.size(), 5U);  // highlights, lobe, difference, two maps
  EXPECT_EQ(plots[0].plot.series[0].y, (std::vector<double>{-0.5}));
  EXPECT_EQ(plots[0].plot.series[1].x, (std::vector<double>{7.0}));
  const PlotSeries& measured = plots[1].plot.series[0];
  const PlotSeries& fitted = plots[1].plot.series[1];
  ASSERT_EQ(measured.x.size(), 2U);
  EXPECT_NEAR(measured.x[0], 0.0, 1e-9);
  EXPECT_NEAR(measured.x[1], 45.0, 1e-9);
  EXPECT_NEAR(fitted.y[1], 100.0 * std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(measured.y[1], 1.02 * fitted.y[1], 1e-9);
  EXPECT_NEAR(plots[2].plot.series[0].y[1], 2.0, 1e-9);
  EXPECT_NEAR(plots[2].plot.series[0].y_std[0], 0.1, 1e-9);
  EXPECT_THAT(plots[3].caption, HasSubstr("plane.dng under led1: rms 1.41 %, worst 2 %."));
  c.fit.cell_used.clear();
  EXPECT_EQ(led_fit_plots(c).size(), 1U);
}

}  // namespace
}  // namespace scattermeter::apps
