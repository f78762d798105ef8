// The verdict on what measuring answers to the shots of a deviating rig.
#pragma once

#include <string>
#include <vector>

#include "core/fit/estimate.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

// True coefficients; a range where the object has more than one material.
struct TrueRange {
  double low = 0, high = 0;
};
struct TrueCoefficients {
  TrueRange sigma_s_prime_per_mm, sigma_a_per_mm;
};
// Of all these media, at least one.
TrueCoefficients true_coefficients(const std::vector<Medium>& media);

enum class DeviationVerdict {
  kRight,    // answered, and not wrong
  kWrongOk,  // answered, and wrong: see is_wrong()
  kRefused,
};
const char* verdict_name(DeviationVerdict verdict);

// Error of an answer beyond the true range: in stated deviations, and relative to the nearest true
// value. An answer without a deviation has infinite error unless it is exact.
struct AnswerError {
  double in_std = 0;
  double relative = 0;
};
AnswerError answer_error(const Quantity& answer, const TrueRange& truth);

// More than three stated deviations and more than this relative error.
inline constexpr double kWrongStds = 3.0;
inline constexpr double kWrongRelativeScattering = 0.01;
inline constexpr double kWrongRelativeAbsorption = 0.05;
bool is_wrong(const AnswerError& error, double relative_limit);

struct JudgedAnswer {
  DeviationVerdict verdict = DeviationVerdict::kRefused;
  AnswerError sigma_s_prime, sigma_a;  // if answered
  int in_interval = 0;  // of the two 95 % intervals, those that reach into the true range
  // Error of the wrong coefficient in stated deviations, the larger of two; 0 unless wrong.
  double wrong_by_std = 0;
  // A reason of the refusal contains one of the words, in any case; or if answered, one of the
  // causes that the answer rests on does.
  bool names_cause = false;
};
JudgedAnswer judge_answer(const Estimate& estimate, const TrueCoefficients& truth,
                          const std::vector<std::string>& words);

// Whether one of the reasons contains one of the words, upper or lower case.
bool names_one_of(const std::vector<std::string>& reasons, const std::vector<std::string>& words);

}  // namespace scattermeter::apps
