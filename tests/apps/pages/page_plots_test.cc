#include "apps/pages/page_plots.h"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

PagePlot page_plot(const std::string& caption, const std::vector<double>& y) {
  PagePlot out;
  out.caption = caption;
  out.plot.series = {{"", PlotSeries::Style::kLine, {1, 2}, y}};
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
  EXPECT_THAT(html.markup, HasSubstr("data:image/svg+xml"));
}

TEST(PagePlots, WithoutGnuplotItsMessageStandsThere) {
  const TemporaryFolder empty;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", empty.path().c_str(), 1);
  const Html html = plot_figures({page_plot("first", {1, 2})});
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(html.markup, HasSubstr("first: "));
  EXPECT_THAT(html.markup, HasSubstr("gnuplot"));
  EXPECT_EQ(figures_in(html.markup), 0);
}

}  // namespace
}  // namespace scattermeter::apps
