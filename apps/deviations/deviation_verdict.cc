#include "apps/deviations/deviation_verdict.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/fit/prior_pulls.h"

namespace scattermeter::apps {
namespace {

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

void widen(TrueRange& range, double value, bool first) {
  range.low = first ? value : std::min(range.low, value);
  range.high = first ? value : std::max(range.high, value);
}

}  // namespace

TrueCoefficients true_coefficients(const std::vector<Medium>& media) {
  if (media.empty()) throw std::invalid_argument("true_coefficients: no medium");
  TrueCoefficients out;
  for (std::size_t i = 0; i < media.size(); ++i) {
    widen(out.sigma_s_prime_per_mm, media[i].sigma_s_prime_per_mm, i == 0);
    widen(out.sigma_a_per_mm, media[i].sigma_a_per_mm, i == 0);
  }
  return out;
}

const char* verdict_name(DeviationVerdict verdict) {
  switch (verdict) {
    case DeviationVerdict::kRight:
      return "right";
    case DeviationVerdict::kWrongOk:
      return "wrong ok";
    case DeviationVerdict::kRefused:
      return "refused";
  }
  return "";
}

AnswerError answer_error(const Quantity& answer, const TrueRange& truth) {
  const double nearest = std::clamp(answer.value, truth.low, truth.high);
  const double error = answer.value - nearest;
  if (error == 0.0) return {};
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  return {answer.std > 0.0 ? error / answer.std : std::copysign(kInfinite, error),
          nearest != 0.0 ? error / nearest : std::copysign(kInfinite, error)};
}

bool is_wrong(const AnswerError& error, double relative_limit) {
  // An answer that is no number is wrong.
  return !(std::abs(error.in_std) <= kWrongStds || std::abs(error.relative) <= relative_limit);
}

bool names_one_of(const std::vector<std::string>& reasons, const std::vector<std::string>& words) {
  return std::any_of(reasons.begin(), reasons.end(), [&](const std::string& reason) {
    const std::string text = lower_case(reason);
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
      return text.find(lower_case(word)) != std::string::npos;
    });
  });
}

JudgedAnswer judge_answer(const Estimate& estimate, const TrueCoefficients& truth,
                          const std::vector<std::string>& words) {
  JudgedAnswer out;
  if (!estimate.reasons.empty()) {
    out.names_cause = names_one_of(estimate.reasons, words);
    return out;
  }
  std::vector<std::string> causes;
  for (const PriorPull& p : rests_on(estimate)) causes.push_back(p.group);
  out.names_cause = names_one_of(causes, words);
  out.sigma_s_prime = answer_error(estimate.sigma_s_prime_per_mm, truth.sigma_s_prime_per_mm);
  out.sigma_a = answer_error(estimate.sigma_a_per_mm, truth.sigma_a_per_mm);
  const auto holds = [](const Quantity& q, const TrueRange& range) {
    return q.low95 <= range.high && q.high95 >= range.low;
  };
  out.in_interval = (holds(estimate.sigma_s_prime_per_mm, truth.sigma_s_prime_per_mm) ? 1 : 0) +
                    (holds(estimate.sigma_a_per_mm, truth.sigma_a_per_mm) ? 1 : 0);
  const bool wrong_s = is_wrong(out.sigma_s_prime, kWrongRelativeScattering);
  const bool wrong_a = is_wrong(out.sigma_a, kWrongRelativeAbsorption);
  out.verdict = wrong_s || wrong_a ? DeviationVerdict::kWrongOk : DeviationVerdict::kRight;
  if (wrong_s) out.wrong_by_std = std::abs(out.sigma_s_prime.in_std);
  if (wrong_a) out.wrong_by_std = std::fmax(out.wrong_by_std, std::abs(out.sigma_a.in_std));
  return out;
}

}  // namespace scattermeter::apps
