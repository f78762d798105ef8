#include "apps/instrument/row_precision.h"

#include <algorithm>
#include <cmath>

#include "core/estimation/model_choice.h"

namespace scattermeter::apps {
namespace {

bool is_in_doubt(const ChannelResult& r) {
  return r.refused() || r.agreement.disagree() || !r.why_transport.empty();
}

// The coefficient's deviation, relative to it, with more rows. now, then: of the fit alone; what
// has widened the estimate after the fit stays.
double forecast(const Quantity& q, double now, double then) {
  return std::sqrt(std::max(0.0, q.std * q.std - now * now) + then * then) / q.value;
}

// With a margin for what is only forecast.
bool suffice(const ChannelResult& r, const MoreRows& some, const PrecisionGoal& goal) {
  constexpr double kHidden = 1e-3;
  const double most = some.times > 1.0 ? 0.9 : 1.0;
  const MoreRows& now = r.more_rows.front();
  const Estimate& e = r.estimate;
  return forecast(e.sigma_s_prime_per_mm, now.std_sigma_s_prime_per_mm,
                  some.std_sigma_s_prime_per_mm) <= most * goal.sigma_s_prime &&
         forecast(e.sigma_a_per_mm, now.std_sigma_a_per_mm, some.std_sigma_a_per_mm) <=
             most * goal.sigma_a &&
         hidden_by_noise(r) / std::sqrt(some.times) <= most * kHidden;
}

}  // namespace

std::optional<int> levels_needed(std::span<const ChannelResult> results, const PrecisionGoal& goal,
                                 int levels, double all_rows) {
  int more = 0;
  for (const ChannelResult& r : results) {
    if (r.estimate.rows == 0) continue;  // refused before any fit
    if (is_in_doubt(r) || r.more_rows.empty()) return std::nullopt;
    const auto enough = std::find_if(r.more_rows.begin(), r.more_rows.end(),
                                     [&](const MoreRows& some) { return suffice(r, some, goal); });
    more = std::max(more, static_cast<int>(enough - r.more_rows.begin()));
  }
  // More than half of the rows cost nearly as much as all of them.
  if (more > 0 && std::exp2(more) > 0.5 * all_rows) return std::nullopt;
  return levels + more;
}

}  // namespace scattermeter::apps
