#include "apps/pages/calibration_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/small_rig.h"
#include "tests/fixtures/temporary_folder.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

TEST(CalibrationPage, VerdictPlotsAndValues) {
  PagePlot plot;
  plot.plot.series = {{"", PlotSeries::Style::kPoints, {1}, {2}}};
  plot.caption = "residuals";
  const std::string page = calibration_page(
      {"Lens <1>", "It failed.", "Take <more>.", false, "f_px   100 px\ncx_px  50 px\n", {plot}},
      "calibrate & so on");
  EXPECT_EQ(html_problem(page), "");
  for (const char* text :
       {"<h1>Lens &lt;1&gt;</h1>", "<p class=\"fail\">It failed.</p>", "Take &lt;more&gt;.",
        "f_px   100 px\ncx_px  50 px\n", "calibrate &amp; so on", "residuals"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

TEST(CalibrationPage, StandsBesideTheFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(write_page_beside(folder / "lens.v2.yaml", "page"),
            "written: " + (folder / "lens.v2.html") + "\n");
  EXPECT_EQ(slurp(folder / "lens.v2.html"), "page");
}

}  // namespace
}  // namespace scattermeter::apps
