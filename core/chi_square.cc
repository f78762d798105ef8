#include "core/chi_square.h"

#include <unsupported/Eigen/SpecialFunctions>

namespace scattermeter {

double chi_square_p_value(double chi2, double dof) {
  return Eigen::numext::igammac(0.5 * dof, 0.5 * chi2);
}

}  // namespace scattermeter
