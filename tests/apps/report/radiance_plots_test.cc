#include "apps/report/radiance_plots.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

// It records 2 % too little at 4000 counts: G(y) = 0.02 y / 4000.
capture::RadianceCalibration straight_departure() {
  capture::RadianceCalibration made;
  made.correction.response.fill(ResponseCurve({4000.0}, {0.02}));
  made.response_covariance.fill({1e-6});
  made.correction.noise.fill({5.0, 2.0});
  made.linearity = {{1000.0, -0.006, 0.0005}, {4000.0, -0.021, 0.0002}};
  made.noise[1] = {{10.0, 6.5, 0.1}, {1000.0, 210.0, 2.0}};
  return made;
}

TEST(RadiancePlots, Linearity) {
  const Plot plot = linearity_plot(straight_departure());
  ASSERT_EQ(plot.series.size(), 4U);
  const PlotSeries& flats = plot.series[0];
  EXPECT_EQ(flats.x, (std::vector<double>{1000.0, 4000.0}));
  EXPECT_NEAR(flats.y[0], -0.6, 1e-12);
  EXPECT_NEAR(flats.y_std[1], 0.02, 1e-12);
  const PlotSeries& curve = plot.series[1];
  EXPECT_EQ(curve.x.front(), 0.0);
  EXPECT_EQ(curve.y.front(), 0.0);
  EXPECT_EQ(curve.x.back(), 4000.0);
  for (std::size_t i = 0; i < curve.x.size(); i += 9) {
    const double g = 0.02 * curve.x[i] / 4000.0;
    EXPECT_NEAR(curve.y[i], 100.0 * (std::exp(-g) - 1.0), 1e-9);
    // The knot's deviation of 0.1 % falls with the counts.
    EXPECT_NEAR(plot.series[3].y[i] - curve.y[i], 0.1 * curve.x[i] / 4000.0, 1e-9);
    EXPECT_NEAR(curve.y[i] - plot.series[2].y[i], 0.1 * curve.x[i] / 4000.0, 1e-9);
  }
}

TEST(RadiancePlots, PhotonTransfer) {
  const Plot plot = photon_transfer_plot(straight_departure(), 1);
  EXPECT_EQ(plot.title, "Photon transfer, G");
  EXPECT_TRUE(plot.x.log && plot.y.log);
  ASSERT_EQ(plot.series.size(), 2U);
  EXPECT_EQ(plot.series[1].y, (std::vector<double>{6.5, 210.0}));
  const PlotSeries& model = plot.series[0];
  EXPECT_NEAR(model.x.front(), 10.0, 1e-9);
  EXPECT_NEAR(model.x.back(), 4000.0, 1e-6);
  for (std::size_t i = 0; i < model.x.size(); i += 9) {
    // light = y e^(a y): its variance is light / gain + read^2, recorded through dy/dlight.
    const double y = model.x[i];
    const double a = 0.02 / 4000.0;
    const double light = y * std::exp(a * y);
    const double slope = std::exp(a * y) * (1.0 + a * y);
    const double expected = (light / 5.0 + 4.0) / (slope * slope);
    EXPECT_NEAR(model.y[i], expected, 1e-9 * expected);
  }
}

// Without a curve the model is a straight line.
TEST(RadiancePlots, ALinearSensor) {
  capture::RadianceCalibration made = straight_departure();
  made.correction.response = {};
  for (std::vector<double>& c : made.response_covariance) c.clear();
  const Plot plot = photon_transfer_plot(made, 1);
  EXPECT_NEAR(plot.series[0].x.back(), 1000.0, 1e-9);
  EXPECT_NEAR(plot.series[0].y.back(), 204.0, 1e-9);
  const Plot straight = linearity_plot(made);
  for (const double y : straight.series.at(3).y) EXPECT_EQ(y, 0.0);
}

}  // namespace
}  // namespace scattermeter::apps
