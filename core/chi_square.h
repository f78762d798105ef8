// The chi-square distribution.
#pragma once

namespace scattermeter {

// Probability that a chi-square variable with `dof` > 0 degrees of freedom exceeds `chi2` >= 0.
double chi_square_p_value(double chi2, double dof);

}  // namespace scattermeter
