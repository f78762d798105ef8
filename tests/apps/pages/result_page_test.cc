#include "apps/pages/result_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/fixtures/apps/html_check.h"
#include "tests/fixtures/apps/made_measurement.h"

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(ResultPage, HoldsTheMeasurementsNumbers) {
  Measurement m = two_channels();
  ChannelResult& red = m.results[0];
  red.model = "dipole";
  red.estimate.budget = {{"noise", 0.00984, 0.000027}, {"scale", 0.00738, 0.000036}};
  red.estimate.reduced_chi2 = 1.25;
  red.patches_by_state[0] = 321;
  red.singles.resize(2);
  red.singles[0].file = "single <1>.dng";
  red.singles[0].estimate = red.estimate;
  red.singles[1].file = "b.dng";
  red.agreement = {30.5, 2, 1e-6};
  m.notes = {"a note & more"};
  m.skipped.shots_from_cache = 7;
  m.skipped.rows = 4321;
  const std::string page = result_page(m, "scattermeter measure <x>");
  EXPECT_EQ(html_problem(page), "");
  for (const char* text : {"1 of 2 values refused.",
                           "scattermeter measure &lt;x&gt; (1.5 s",
                           "2.193 ± 0.012",
                           "0.002013 ± 0.000045",
                           "2.170 … 2.220",
                           "1.23 %",
                           ">1.25<",
                           "POM G is refused: a.dng: channel G is dark.",
                           "a note &amp; more",
                           "7 shots taken from the cache",
                           "4321 patches in the shots were left out",
                           "value=\"0.6400\">64 %<",
                           "value=\"0.3600\">36 %<",
                           "single &lt;1&gt;.dng",
                           "no (p = 1e-06)",
                           "R: the shots do not agree (chi2 30.5 at 2 degrees of freedom",
                           "R: 321 in use",
                           "rig.yaml",
                           "00ff",
                           "1 files"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

TEST(ResultPage, AllMeasured) {
  Measurement m = two_channels();
  m.results.pop_back();
  m.brackets = {{"short.dng",
                 {{"short.dng", 0.1, {1, 1, 1}, {}}, {"long.dng", 1.0, {0, 1, 0}, {}}},
                 {1, 1, 1},
                 {}}};
  const std::string page = result_page(m, "");
  EXPECT_EQ(html_problem(page), "");
  EXPECT_THAT(page, HasSubstr("All 1 values measured."));
  EXPECT_THAT(page, Not(HasSubstr("refused")));
  EXPECT_THAT(page, HasSubstr("Bracket short.dng: 2 files merged"));
  EXPECT_THAT(page, Not(HasSubstr("Single shots")));
}

// Beside the values, and with the colours of the material.
TEST(ResultPage, ShowsAMeasuredMaterialTwice) {
  Measurement m = two_channels();
  m.results = {m.results[0], m.results[0], m.results[0]};
  m.results[1].channel = 'G';
  m.results[2].channel = 'B';
  const std::string page = result_page(m, "");
  EXPECT_EQ(html_problem(page), "");
  const std::string picture = "<img class=\"look\" src=\"data:image/png;base64,";
  const std::size_t first = page.find(picture);
  ASSERT_NE(first, std::string::npos);
  const std::size_t second = page.find(picture, first + 1);
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(page.find(">POM"), first);
  EXPECT_LT(page.find("What it looks like"), second);
  EXPECT_EQ(page.find(picture, second + 1), std::string::npos);
}

}  // namespace
}  // namespace scattermeter::apps
