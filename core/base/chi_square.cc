#include "core/base/chi_square.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <unsupported/Eigen/SpecialFunctions>

namespace scattermeter {

double chi_square_tail(double chi2, double dof) {
  if (!(chi2 >= 0.0) || !(dof > 0.0)) {
    throw std::invalid_argument("chi_square_tail: chi2 " + std::to_string(chi2) + ", dof " +
                                std::to_string(dof));
  }
  if (std::isinf(chi2)) return 0.0;
  return Eigen::numext::igammac(0.5 * dof, 0.5 * chi2);
}

double as_chi_square(double sum) {
  return std::isnan(sum) ? std::numeric_limits<double>::infinity() : std::max(0.0, sum);
}

}  // namespace scattermeter
