#include "apps/deviations/deviation_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

DeviationResult result(const char* kind, std::size_t size_idx, double s, double s_std,
                       const std::vector<std::string>& reasons = {}) {
  DeviationResult r;
  r.run.kind = &deviation_named(kind);
  r.run.size_idx = size_idx;
  r.run.body = "cube";
  r.truth = true_coefficients({{1.0, 0.01, 1.0}});
  r.estimate.sigma_s_prime_per_mm = normal_quantity(s, s_std);
  r.estimate.sigma_a_per_mm = normal_quantity(0.01, 1e-3);
  r.estimate.reasons = reasons;
  r.judged = judge_answer(r.estimate, r.truth, r.run.kind->words);
  return r;
}

// One right, two wrong and three refused answers.
std::vector<DeviationResult> made_up() {
  DeviationResult volume = result("mesh displaced in x", 2, 1.2, 0.01);
  volume.run.volume = true;
  return {result("none", 0, 1.0, 0.01),
          result("mesh displaced in x", 0, 1.0, 0.01, {"The noise is high."}),
          result("mesh displaced in x", 2, 1.1, 0.01),
          volume,
          result("mesh displaced in x", 2, 1.1, 0.01, {"The outline is displaced."}),
          result("even light", 0, 1.0, 0.01, {"There is light from elsewhere."})};
}

TEST(DeviationReport, Counts) {
  const DeviationSummary s = summarise(made_up());
  EXPECT_EQ(s.total.runs, 6);
  EXPECT_EQ(s.total.right, 1);
  EXPECT_EQ(s.total.wrong_ok, 2);
  EXPECT_EQ(s.total.refused, 3);
  EXPECT_EQ(s.total.named, 2);
  EXPECT_NEAR(s.total.worst_by_std, 20.0, 1e-9);
  EXPECT_NEAR(s.total.answered_share(), 0.5, 1e-12);
  EXPECT_NEAR(s.total.named_share(), 2.0 / 3.0, 1e-12);
  EXPECT_EQ(s.volume.runs, 1);
  EXPECT_EQ(s.dipole.runs, 5);
  EXPECT_EQ(s.within.runs, 3);
  EXPECT_NEAR(s.within.answered_share(), 1.0 / 3.0, 1e-12);
  ASSERT_EQ(s.kinds.size(), 3U);
  EXPECT_EQ(s.kinds[0].kind->name, "none");
  EXPECT_EQ(s.kinds[1].by_size[2].wrong_ok, 2);
  EXPECT_EQ(s.kinds[1].by_size[0].refused, 1);
}

TEST(DeviationReport, WrongOnesThatSayWhatTheyRestOn) {
  std::vector<DeviationResult> results = made_up();
  for (const std::size_t i : {0U, 2U}) results[i].judged.names_cause = true;
  const DeviationSummary s = summarise(results);
  EXPECT_EQ(s.total.wrong_told, 1);
  EXPECT_EQ(s.total.named, 2);
  EXPECT_EQ(s.kinds[1].by_size[2].wrong_told, 1);
}

TEST(DeviationReport, IntervalsThatHold) {
  const DeviationSummary s = summarise(made_up());
  // 1.0 +- 0.01 holds both coefficients, 1.1 and 1.2 +- 0.01 only sigma_a.
  EXPECT_EQ(s.total.in_interval, 4);
  EXPECT_NEAR(s.total.coverage95(), 4.0 / 6.0, 1e-12);
}

TEST(DeviationReport, BudgetByCause) {
  DeviationResult r = result("none", 0, 1.0, 0.01);
  r.estimate.budget = {{"scale", 0.008, 0.0}, {"noise", 0.006, 1e-3}};
  const std::string table =
      deviation_budget_table({r, result("mesh displaced in x", 2, 1.1, 0.01)});
  // 0.64 and 0.36 of the variance: 1 / 0.6 and 1 / 0.8 as wide.
  EXPECT_THAT(table, HasSubstr("64.0 %"));
  EXPECT_THAT(table, HasSubstr("66.7 %"));
  EXPECT_THAT(table, HasSubstr("25.0 %"));
  EXPECT_EQ(deviation_budget_table({result("mesh displaced in x", 2, 1.1, 0.01)}), "");
}

TEST(DeviationReport, Texts) {
  const std::vector<DeviationResult> results = made_up();
  const std::string table = deviation_table(results);
  EXPECT_THAT(table, HasSubstr("within what the rig states"));
  const std::string wrong = deviation_line(results[2]);
  EXPECT_THAT(wrong, HasSubstr("wrong ok: mesh displaced in x 3 mm, cube, 2 LEDs, dipole"));
  EXPECT_THAT(wrong, HasSubstr("+10.0 %, +10.0 s"));
  EXPECT_THAT(deviation_line(results[4]), HasSubstr("refused"));
  EXPECT_THAT(deviation_line(results[4]), HasSubstr("The outline is displaced."));
  const std::string csv = deviation_csv(results);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6);
  EXPECT_THAT(csv, HasSubstr("wrong ok"));
  EXPECT_THAT(deviation_list(), HasSubstr("veiling glare"));
  EXPECT_THAT(deviation_table({result("none", 0, 1.0, 0.01)}), Not(HasSubstr("veiling glare")));
}

}  // namespace
}  // namespace scattermeter::apps
