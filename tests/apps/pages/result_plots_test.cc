#include "apps/pages/result_plots.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/material/dipole.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

ChannelResult measured_green() {
  ChannelResult r;
  r.material = "POM";
  r.channel = 'G';
  r.eta_int_over_ext = 1.4;
  r.model = "dipole";
  r.estimate.converged = true;
  r.estimate.sigma_s_prime_per_mm = normal_quantity(1.5, 0.03);
  r.estimate.sigma_a_per_mm = normal_quantity(0.01, 0.002);
  r.estimate.correlation = 0.6;
  return r;
}

// Every point lies on the curve of constant chi-square that holds 95 % of a normal pair.
TEST(ResultPlots, EllipseHolds95PerCent) {
  const ChannelResult r = measured_green();
  const std::vector<PagePlot> plots = ellipse_plots(r);
  ASSERT_EQ(plots.size(), 1U);
  const Plot& plot = plots[0].plot;
  ASSERT_EQ(plot.series.size(), 2U);
  const PlotSeries& ellipse = plot.series[0];
  for (std::size_t i = 0; i < ellipse.x.size(); ++i) {
    const double u = (ellipse.x[i] - 1.5) / 0.03;
    const double v = (ellipse.y[i] - 0.01) / 0.002;
    const double chi2 = (u * u - 2.0 * 0.6 * u * v + v * v) / (1.0 - 0.36);
    EXPECT_NEAR(chi2, 5.991464547, 1e-6);
  }
  EXPECT_EQ(plot.series[1].x, std::vector<double>{1.5});
  EXPECT_EQ(plot.series[1].y, std::vector<double>{0.01});
  EXPECT_NEAR(*plot.x.min, 1.5 - 6.0 * 0.03, 1e-12);
  EXPECT_NEAR(*plot.y.max, 0.01 + 6.0 * 0.002, 1e-12);
  EXPECT_THAT(plots[0].caption, HasSubstr("correlation 0.60"));
}

TEST(ResultPlots, SingleShotsNearby) {
  ChannelResult r = measured_green();
  for (const double s : {1.52, 1.69, 1.40}) {
    ShotResult& shot = r.singles.emplace_back();
    shot.estimate.converged = s != 1.40;
    shot.estimate.sigma_s_prime_per_mm.value = s;
    shot.estimate.sigma_a_per_mm.value = 0.011;
  }
  const PagePlot page = ellipse_plots(r).at(0);
  ASSERT_EQ(page.plot.series.size(), 3U);
  EXPECT_EQ(page.plot.series[2].x, std::vector<double>{1.52});  // 1.69 is beyond six deviations
  EXPECT_THAT(page.caption, HasSubstr("1 of 3 within this plot"));
}

TEST(ResultPlots, WithoutAnEstimateNothing) {
  ChannelResult r = measured_green();
  r.estimate.converged = false;
  EXPECT_TRUE(ellipse_plots(r).empty());
  r = measured_green();
  r.estimate.sigma_a_per_mm.std = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(ellipse_plots(r).empty());
  EXPECT_TRUE(reflectance_plots(measured_green()).empty());
}

TEST(ResultPlots, ReflectanceAndItsDipole) {
  ChannelResult r = measured_green();
  SmoothReflectance& recovered = r.recovered.emplace();
  for (const double d : {0.0, 0.5, 1.0, 4.0, 9.0}) {
    ReflectanceKnot& k = recovered.knots.emplace_back();
    k.distance_mm = d;
    k.r_per_mm2 = std::exp(-d);
    k.log_std = d == 4.0 ? std::numeric_limits<double>::infinity() : 0.1;
    k.shape_log_std = 0.2;
    k.determined = d < 9.0;
  }
  const Plot plot = reflectance_plots(r).at(0).plot;
  ASSERT_EQ(plot.series.size(), 2U);
  const PlotSeries& curve = plot.series[0];
  const PlotSeries& seen = plot.series[1];
  EXPECT_EQ(seen.x, (std::vector<double>{0.5, 1.0, 4.0}));
  EXPECT_NEAR(seen.y[1], std::exp(-1.0), 1e-12);
  EXPECT_NEAR(seen.y_std[1], 0.1 * std::exp(-1.0), 1e-12);
  EXPECT_NEAR(seen.y_std[2], 0.2 * std::exp(-4.0), 1e-12);  // the scale is free
  EXPECT_EQ(curve.x.front(), 0.5);
  EXPECT_NEAR(curve.x.back(), 4.0, 1e-12);
  const Dipole dipole({1.5, 0.01, 1.4});
  for (std::size_t i = 0; i < curve.x.size(); i += 17) {
    EXPECT_EQ(curve.y[i], dipole.reflectance_per_mm2(curve.x[i]));
  }
  EXPECT_TRUE(plot.x.log && plot.y.log);
  // Of transport, both: what it says, dashed, and the dipole as fitted.
  r.model = "transport";
  r.dipole = r.estimate;
  r.dipole->sigma_s_prime_per_mm.value = 1.4;
  const Plot both = reflectance_plots(r).at(0).plot;
  ASSERT_EQ(both.series.size(), 3U);
  EXPECT_EQ(both.series[0].style, PlotSeries::Style::kDashedLine);
  EXPECT_EQ(both.series[1].y.front(), Dipole({1.4, 0.01, 1.4}).reflectance_per_mm2(0.5));
}

}  // namespace
}  // namespace scattermeter::apps
