#include "core/fit/profile_interval.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scattermeter {
namespace {

// Rise of the chi-square at a value; infinite where it cannot be reached.
class Profile {
 public:
  Profile(const DipoleSolver& solver, const DipoleSolver::Point& best,
          DipoleSolver::Coefficient coefficient)
      : solver_(solver), best_(best), last_(best), coefficient_(coefficient) {}

  double rise(double value_per_mm) {
    const auto p = solver_.best_with(coefficient_, value_per_mm, last_);
    if (!p) return std::numeric_limits<double>::infinity();
    last_ = *p;  // a near start for the next value
    return p->cost - best_.cost;
  }

 private:
  const DipoleSolver& solver_;
  const DipoleSolver::Point& best_;
  DipoleSolver::Point last_;
  DipoleSolver::Coefficient coefficient_;
};

// Where the rise passes the limit between `inside` and `outside`.
double crossing(Profile& profile, double inside, double outside, double tolerance, double limit) {
  while (std::abs(outside - inside) > tolerance) {
    const double middle = 0.5 * (inside + outside);
    (profile.rise(middle) <= limit ? inside : outside) = middle;
  }
  return 0.5 * (inside + outside);
}

}  // namespace

Interval profile_interval(const DipoleSolver& solver, const DipoleSolver::Point& best,
                          DipoleSolver::Coefficient coefficient, double std_per_mm, double rise) {
  const double value = coefficient == DipoleSolver::Coefficient::kSigmaA
                           ? best.sigma_a_per_mm()
                           : best.sigma_s_prime_per_mm();
  const double step = std::sqrt(rise) * std_per_mm;
  const double tolerance = 0.005 * step;
  Interval out{0.0, std::numeric_limits<double>::infinity()};
  Profile up(solver, best, coefficient);
  double inside = value;
  for (double reach = step; reach < 1000.0 * step; reach *= 2.0) {
    if (up.rise(value + reach) > rise) {
      out.high = crossing(up, inside, value + reach, tolerance, rise);
      break;
    }
    inside = value + reach;
  }
  Profile down(solver, best, coefficient);
  inside = value;
  for (double reach = step; inside > 0.0; reach *= 2.0) {
    const double at = std::max(0.0, value - reach);
    if (down.rise(at) > rise) {
      out.low = crossing(down, inside, at, tolerance, rise);
      break;
    }
    inside = at;
  }
  return out;
}

}  // namespace scattermeter
