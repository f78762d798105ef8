#include "apps/checking/check_item.h"

#include <cmath>
#include <utility>

namespace scattermeter::apps {
namespace {

bool passes(const CheckDetail& d, const CheckLimit& limit) {
  if (!std::isfinite(d.value)) return false;
  if (limit.at_least) return d.value >= limit.value;
  if ((limit.above_only ? d.value : std::abs(d.value)) <= limit.value) return true;
  return limit.least_stds > 0.0 && !(std::abs(d.value) > limit.least_stds * d.std);
}

// Order of the values: the largest is the worst.
double badness(const CheckDetail& d, const CheckLimit& limit) {
  if (!std::isfinite(d.value)) return std::numeric_limits<double>::infinity();
  if (limit.at_least) return -d.value;
  return limit.above_only ? d.value : std::abs(d.value);
}

}  // namespace

CheckItem judged(const std::string& what, const std::string& unit, const CheckLimit& limit,
                 const std::string& advice, std::vector<CheckDetail> details) {
  CheckItem item;
  item.what = what;
  item.unit = unit;
  item.limit = limit.value;
  item.at_least = limit.at_least;
  item.advice = advice;
  item.details = std::move(details);
  const CheckDetail* worst = nullptr;
  double squares = 0.0;
  for (const CheckDetail& d : item.details) {
    squares += d.value * d.value;
    const bool ok = passes(d, limit);
    // Any that fails is worse than all that pass.
    const bool worse = worst == nullptr || (item.passed && !ok) ||
                       (item.passed == ok && badness(d, limit) > badness(*worst, limit));
    if (worse) worst = &d;
    item.passed = item.passed && ok;
  }
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  item.rms =
      worst == nullptr ? kNone : std::sqrt(squares / static_cast<double>(item.details.size()));
  item.worst = worst == nullptr ? kNone : worst->value;
  // If all are 0, none is the worst.
  if (worst != nullptr && worst->value != 0.0) item.where = worst->where;
  return item;
}

}  // namespace scattermeter::apps
