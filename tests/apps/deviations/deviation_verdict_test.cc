#include "apps/deviations/deviation_verdict.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter::apps {
namespace {

Estimate answered(double s, double s_std, double a, double a_std) {
  Estimate e;
  e.sigma_s_prime_per_mm = normal_quantity(s, s_std);
  e.sigma_a_per_mm = normal_quantity(a, a_std);
  return e;
}

const TrueCoefficients kTruth = true_coefficients({{1.0, 0.01, 1.0}});

DeviationVerdict verdict(const Estimate& e) { return judge_answer(e, kTruth, {}).verdict; }

TEST(DeviationVerdict, RightAnswers) {
  EXPECT_EQ(verdict(answered(1.0, 0.01, 0.01, 1e-4)), DeviationVerdict::kRight);
  // Off by much, but not by more than three stated deviations.
  EXPECT_EQ(verdict(answered(1.29, 0.1, 0.01, 1e-4)), DeviationVerdict::kRight);
  EXPECT_EQ(verdict(answered(1.0, 0.01, 0.0129, 0.001)), DeviationVerdict::kRight);
  // By many stated deviations, but not by more than 1 % and 5 %.
  EXPECT_EQ(verdict(answered(1.0099, 1e-5, 0.01, 1e-4)), DeviationVerdict::kRight);
  EXPECT_EQ(verdict(answered(1.0, 0.01, 0.01049, 1e-6)), DeviationVerdict::kRight);
}

TEST(DeviationVerdict, WrongOk) {
  const JudgedAnswer s = judge_answer(answered(0.95, 0.01, 0.01, 1e-4), kTruth, {});
  EXPECT_EQ(s.verdict, DeviationVerdict::kWrongOk);
  EXPECT_NEAR(s.wrong_by_std, 5.0, 1e-9);
  EXPECT_NEAR(s.sigma_s_prime.relative, -0.05, 1e-12);
  const JudgedAnswer a = judge_answer(answered(1.0, 0.01, 0.011, 0.0002), kTruth, {});
  EXPECT_EQ(a.verdict, DeviationVerdict::kWrongOk);
  EXPECT_NEAR(a.wrong_by_std, 5.0, 1e-9);
  // The deviation of the coefficient that is not wrong does not count.
  EXPECT_NEAR(judge_answer(answered(1.009, 1e-4, 0.011, 0.0002), kTruth, {}).wrong_by_std, 5.0,
              1e-9);
  // Answers that are no numbers or claim to be exact.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdict(answered(nan, 0.01, 0.01, 1e-4)), DeviationVerdict::kWrongOk);
  EXPECT_EQ(verdict(answered(1.0, 0.01, nan, nan)), DeviationVerdict::kWrongOk);
  EXPECT_EQ(verdict(answered(1.1, 0.0, 0.01, 1e-4)), DeviationVerdict::kWrongOk);
}

TEST(DeviationVerdict, RefusalsByName) {
  Estimate e = answered(3.0, 0.01, 0.01, 1e-4);
  e.reasons = {"The image differs from the model.", "Its OUTLINE is displaced."};
  EXPECT_EQ(judge_answer(e, kTruth, {}).verdict, DeviationVerdict::kRefused);
  EXPECT_FALSE(judge_answer(e, kTruth, {}).names_cause);
  EXPECT_TRUE(judge_answer(e, kTruth, {"mesh", "outline"}).names_cause);
  EXPECT_FALSE(judge_answer(e, kTruth, {"mesh"}).names_cause);
  EXPECT_EQ(judge_answer(e, kTruth, {"mesh"}).wrong_by_std, 0.0);
}

// A wrong answer that says that it rests on what is off.
TEST(DeviationVerdict, WrongButTold) {
  Estimate e = answered(0.95, 0.01, 0.01, 1e-4);
  e.pulls = {{"scale", "scale"}};
  e.pulls[0].unseen_sigma_s_prime_per_mm = 0.2;
  EXPECT_EQ(judge_answer(e, kTruth, {"scale"}).verdict, DeviationVerdict::kWrongOk);
  EXPECT_TRUE(judge_answer(e, kTruth, {"scale"}).names_cause);
  EXPECT_FALSE(judge_answer(e, kTruth, {"eta"}).names_cause);
  e.pulls[0].unseen_sigma_s_prime_per_mm = 0.02;
  EXPECT_FALSE(judge_answer(e, kTruth, {"scale"}).names_cause);
}

TEST(DeviationVerdict, RangeOfTruths) {
  const TrueCoefficients truth = true_coefficients({{1.5, 0.01, 1.0}, {1.0, 0.02, 1.0}});
  EXPECT_EQ(answer_error(normal_quantity(1.2, 0.1), truth.sigma_s_prime_per_mm).in_std, 0.0);
  const AnswerError below = answer_error(normal_quantity(0.8, 0.1), truth.sigma_s_prime_per_mm);
  EXPECT_NEAR(below.in_std, -2.0, 1e-12);
  EXPECT_NEAR(below.relative, -0.2, 1e-12);
  const AnswerError above = answer_error(normal_quantity(0.03, 0.01), truth.sigma_a_per_mm);
  EXPECT_NEAR(above.in_std, 1.0, 1e-12);
  EXPECT_NEAR(above.relative, 0.5, 1e-12);
  EXPECT_THROW(true_coefficients({}), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter::apps
