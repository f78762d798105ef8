#include "apps/pages/page_plots.h"

#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

PagePlot page_plot(const std::string& caption, const std::vector<double>& y) {
  PagePlot out;
  out.caption = caption;
  std::vector<double> x;
  while (x.size() < y.size()) x.push_back(static_cast<double>(x.size()));
  out.plot.series = {{"", PlotSeries::Style::kLine, x, y}};
  return out;
}

int figures_in(const std::string& markup) {
  int n = 0;
  for (std::size_t at = 0; (at = markup.find("<figure", at)) != std::string::npos; ++at) ++n;
  return n;
}

TEST(PagePlots, OneThatCannotBeDrawnHidesNoOther) {
  const Html html = plot_figures(
      {page_plot("first <1>", {1, 2}), page_plot("none", {}), page_plot("last", {3, 1})});
  EXPECT_EQ(html_problem(html_document("t", html)), "");
  EXPECT_THAT(html.markup, HasSubstr("first &lt;1&gt;"));
  EXPECT_THAT(html.markup, HasSubstr("last"));
  EXPECT_THAT(html.markup, Not(HasSubstr("none")));
  EXPECT_EQ(figures_in(html.markup), 2);
}

TEST(PagePlots, DataIsWhatTheScriptDraws) {
  Plot plot;
  plot.title = "r(d) <script>";
  plot.x = {"d [mm]", true};
  plot.y = {"r [1/mm^2]", false, 0.0};
  plot.series = {{"fit", PlotSeries::Style::kDashedLine, {1, 0, 2}, {5, 6, 1.0 / 3.0}},
                 {"", PlotSeries::Style::kPoints, {0}, {1}}};
  plot.series[0].y_std = {0.1, 0.2, kNaN};
  // Zero has no place on a log axis; the second series has nothing else.
  EXPECT_EQ(plot_data(plot),
            R"({"title":"r(d) <script>","x":{"label":"d [mm]","log":true,"min":null,"max":null},)"
            R"("y":{"label":"r [1/mm^2]","log":false,"min":0.0,"max":null},"y_down":false,)"
            R"("equal":false,"colours":{"label":"","full_scale":1.0,"min":null,"log":false},)"
            R"("series":[{"name":"fit","style":"dashed","look":null,"x":[1.0,2.0],)"
            R"("y":[5.0,0.333333],"std":[0.1,null]}]})");
  EXPECT_THAT(plot_figures({{plot, "caption"}}).markup, Not(HasSubstr("<script>")));
  plot.series[0].y.pop_back();
  EXPECT_THROW(plot_data(plot), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
