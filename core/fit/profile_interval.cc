#include "core/fit/profile_interval.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/side_by_side.h"

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

// A value, and the root of the rise there over that of the limit, minus 1: nearly linear.
struct End {
  double at_per_mm;
  double excess;
};

// Where the excess is 0, between an end with no more and one with more. Secants, with Illinois'
// halving of the end that stays (Dowell & Jarratt 1971), or the middle beside what cannot be
// reached.
double crossing(End inside, End outside, double tolerance_per_mm, double tolerance_excess,
                const std::function<double(double)>& excess) {
  bool inside_moved = false, outside_moved = false;
  while (std::abs(outside.at_per_mm - inside.at_per_mm) > tolerance_per_mm) {
    const double share =
        std::isfinite(outside.excess) ? inside.excess / (inside.excess - outside.excess) : 0.5;
    End next{inside.at_per_mm + share * (outside.at_per_mm - inside.at_per_mm), 0.0};
    next.excess = excess(next.at_per_mm);
    if (std::abs(next.excess) <= tolerance_excess) return next.at_per_mm;
    if (next.excess <= 0.0) {
      inside = next;
      if (inside_moved) outside.excess *= 0.5;
    } else {
      outside = next;
      if (outside_moved) inside.excess *= 0.5;
    }
    inside_moved = next.excess <= 0.0;
    outside_moved = !inside_moved;
  }
  return 0.5 * (inside.at_per_mm + outside.at_per_mm);
}

}  // namespace

Interval profile_interval(const DipoleSolver& solver, const DipoleSolver::Point& best,
                          DipoleSolver::Coefficient coefficient, double std_per_mm, double rise) {
  const double value = coefficient == DipoleSolver::Coefficient::kSigmaA
                           ? best.sigma_a_per_mm()
                           : best.sigma_s_prime_per_mm();
  const double step = std::sqrt(rise) * std_per_mm;
  constexpr double kTolerance = 0.005;
  Interval out{0.0, std::numeric_limits<double>::infinity()};
  // Doubles the reach until the end lies within; direction: 1 or -1.
  const auto search = [&](double direction, double& end) {
    Profile profile(solver, best, coefficient);
    const auto excess = [&](double at_per_mm) {
      return std::sqrt(std::max(0.0, profile.rise(at_per_mm)) / rise) - 1.0;
    };
    End inside{value, -1.0};
    for (double reach = step; reach < 1000.0 * step; reach *= 2.0) {
      End outside{std::max(0.0, value + direction * reach), 0.0};
      outside.excess = excess(outside.at_per_mm);
      if (outside.excess > 0.0) {
        end = outside.excess <= kTolerance
                  ? outside.at_per_mm
                  : crossing(inside, outside, kTolerance * step, kTolerance, excess);
        return;
      }
      if (outside.at_per_mm == 0.0) return;
      inside = outside;
    }
  };
  side_by_side([&] { search(1.0, out.high); }, [&] { search(-1.0, out.low); });
  return out;
}

}  // namespace scattermeter
