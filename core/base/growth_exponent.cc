#include "core/base/growth_exponent.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace scattermeter {

double growth_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size()) throw std::invalid_argument("growth_exponent: x and y");
  double n = 0, su = 0, sv = 0, suu = 0, suv = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), v = std::log(y[i]);
    n += 1;
    su += u;
    sv += v;
    suu += u * u;
    suv += u * v;
  }
  const double spread = n * suu - su * su;
  return spread > 0.0 ? (n * suv - su * sv) / spread : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace scattermeter
