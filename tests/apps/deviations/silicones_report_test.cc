#include "apps/deviations/silicones_report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;

Quantity quantity(double value, double std) {
  Quantity q;
  q.value = value;
  q.std = std;
  q.low95 = value - 1.96 * std;
  q.high95 = value + 1.96 * std;
  return q;
}

// One answer 1 % and 10 % off within its deviations, one refused, one wrong: 20 stated deviations
// off in sigma_s'.
SiliconeResult result_of(const std::string& body, int images) {
  SiliconeResult r;
  r.body = body;
  r.silicone = "white";
  r.images = images;
  const auto answer = [&](std::size_t c, const Quantity& s, const Quantity& a) {
    SiliconeAnswer& out = r.channel[c];
    out.truth = {1.0, 0.01, 1.0};
    out.estimate.sigma_s_prime_per_mm = s;
    out.estimate.sigma_a_per_mm = a;
    if (c == 1) out.estimate.reasons = {"the time was too short"};
    out.judged = judge_answer(out.estimate, true_coefficients({out.truth}), {});
  };
  answer(0, quantity(1.01, 0.01), quantity(0.011, 0.002));
  answer(1, quantity(7.0, 0.01), quantity(0.5, 0.002));
  answer(2, quantity(1.20, 0.01), quantity(0.010, 0.002));
  r.colour_difference = 0.7;
  return r;
}

TEST(SiliconesReport, SummariesCountWhatIsAnswered) {
  SiliconeResult refused = result_of("bust", 1);
  for (SiliconeAnswer& a : refused.channel) a = refused.channel[1];
  refused.colour_difference = std::numeric_limits<double>::quiet_NaN();
  const std::vector<SiliconeSummary> all =
      summarise({result_of("cube", 1), result_of("cube", 1), result_of("cube", 3), refused});
  ASSERT_EQ(all.size(), 3U);
  const SiliconeSummary& cube = all[0];
  EXPECT_EQ(cube.answers, 6);
  EXPECT_EQ(cube.answered, 4);
  EXPECT_EQ(cube.wrong_ok, 2);
  EXPECT_EQ(cube.in_interval, 2 * (2 + 1));
  EXPECT_NEAR(cube.largest_scattering, 0.20, 1e-12);
  EXPECT_NEAR(cube.largest_absorption, 0.10, 1e-12);
  EXPECT_NEAR(cube.root_mean_square_scattering, std::sqrt((0.01 * 0.01 + 0.2 * 0.2) / 2), 1e-12);
  EXPECT_EQ(cube.colour_difference, 0.7);
  EXPECT_EQ(all[1].images, 3);
  EXPECT_EQ(all[2].answered, 0);
}

TEST(SiliconesReport, TablesShowTheAnswersBesideThePublishedErrors) {
  const std::vector<SiliconeResult> results = {result_of("cube", 1), result_of("bust", 3)};
  const std::string table = silicones_table(results);
  EXPECT_THAT(table, HasSubstr("1.01 +- 0.01 (+1.0 %)"));
  EXPECT_THAT(table, HasSubstr("refused"));
  EXPECT_THAT(table, HasSubstr("0.70"));
  const std::string summary = silicones_summary_table(results);
  EXPECT_THAT(summary, HasSubstr("4 to 10 %"));
  EXPECT_THAT(summary, HasSubstr("20.0 %"));
  EXPECT_THAT(summary, ::testing::Not(HasSubstr("16 to 19 %")));  // three images: none published
  const std::string csv = silicones_csv(results);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6);
  EXPECT_THAT(csv, HasSubstr("cube,1,white,0,B,wrong ok,1,1.2,0.01,0.01,0.01,0.002,1,0.7"));
}

}  // namespace
}  // namespace scattermeter::apps
