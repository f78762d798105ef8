#include "core/chi_square.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace scattermeter {

double chi_square_tail(double chi2, double dof) {
  if (!(chi2 >= 0.0) || !(dof > 0.0)) {
    throw std::invalid_argument("chi_square_tail: chi2 " + std::to_string(chi2) + ", dof " +
                                std::to_string(dof));
  }
  const double a = 0.5 * dof;
  const double x = 0.5 * chi2;
  if (x == 0.0) return 1.0;
  if (std::isinf(x)) return 0.0;
  constexpr int kTerms = 100000;
  constexpr double kAccuracy = 1e-15;
  const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
  if (x < a + 1.0) {
    double term = 1.0 / a;
    double sum = term;
    for (int n = 1; n < kTerms && term > kAccuracy * sum; ++n) {
      term *= x / (a + n);
      sum += term;
    }
    return 1.0 - front * sum;
  }
  // Lentz's evaluation of 1/(x + 1 - a - 1 (1 - a)/(x + 3 - a - ...)).
  double b = x + 1.0 - a;
  double c = 1e300;
  double d = 1.0 / b;
  double h = d;
  for (int n = 1; n < kTerms; ++n) {
    const double numerator = -n * (n - a);
    b += 2.0;
    d = 1.0 / (numerator * d + b);
    c = b + numerator / c;
    h *= d * c;
    if (std::abs(d * c - 1.0) < kAccuracy) break;
  }
  return front * h;
}

}  // namespace scattermeter
