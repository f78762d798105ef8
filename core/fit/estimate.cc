#include "core/fit/estimate.h"

#include <fmt/core.h>

namespace scattermeter {
namespace {

void add_once(std::string reason, std::vector<std::string>& reasons) {
  if (std::find(reasons.begin(), reasons.end(), reason) == reasons.end()) {
    reasons.push_back(std::move(reason));
  }
}

}  // namespace

bool is_near(const Estimate& estimate, const Estimate& to, double of_std) {
  const auto close = [&](const Quantity& a, const Quantity& b) {
    return std::abs(a.value - b.value) <= of_std * b.std;
  };
  return close(estimate.sigma_s_prime_per_mm, to.sigma_s_prime_per_mm) &&
         close(estimate.sigma_a_per_mm, to.sigma_a_per_mm);
}

void widen(const BudgetLine& by, double covariance, Estimate& estimate) {
  Quantity& s = estimate.sigma_s_prime_per_mm;
  Quantity& a = estimate.sigma_a_per_mm;
  covariance += estimate.correlation * s.std * a.std;
  const auto grow = [](Quantity& q, double std) {
    const double factor = q.std > 0.0 ? std::hypot(q.std, std) / q.std : 1.0;
    q.std = std::hypot(q.std, std);
    q.low95 = std::max(0.0, q.value - factor * (q.value - q.low95));
    q.high95 = q.value + factor * (q.high95 - q.value);
  };
  grow(s, by.std_sigma_s_prime_per_mm);
  grow(a, by.std_sigma_a_per_mm);
  if (s.std > 0.0 && a.std > 0.0) estimate.correlation = covariance / (s.std * a.std);
  for (BudgetLine& line : estimate.budget) {
    if (line.cause != by.cause) continue;
    line.std_sigma_s_prime_per_mm =
        std::hypot(line.std_sigma_s_prime_per_mm, by.std_sigma_s_prime_per_mm);
    line.std_sigma_a_per_mm = std::hypot(line.std_sigma_a_per_mm, by.std_sigma_a_per_mm);
    return;
  }
  estimate.budget.push_back(by);
}

void refuse_undetermined(Estimate& estimate) {
  const Quantity& s = estimate.sigma_s_prime_per_mm;
  const Quantity& a = estimate.sigma_a_per_mm;
  if (is_upper_limit(s)) {
    add_once(fmt::format("these shots do not determine sigma_s': it is below {:.2g} per mm, and "
                         "may be 0 (use more light, or a smaller piece)",
                         s.high95),
             estimate.reasons);
  } else if (is_undetermined(s)) {
    add_once(
        "these shots do not determine sigma_s' (no absolute scale and no light edge on the "
        "object, or too little light)",
        estimate.reasons);
  }
  if (!std::isfinite(a.std) || !std::isfinite(a.high95) || !std::isfinite(s.high95)) {
    add_once("these shots set no upper limit to a coefficient", estimate.reasons);
  } else if (is_undetermined(a) && !is_upper_limit(a)) {
    add_once(fmt::format("these shots do not determine sigma_a: {:.2g} +- {:.2g} per mm (expose "
                         "longer, or add shots under another LED)",
                         a.value, a.std),
             estimate.reasons);
  }
}

}  // namespace scattermeter
