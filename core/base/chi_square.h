// The tail of the chi-square distribution.
#pragma once

namespace scattermeter {

// Probability that a chi-square of `dof` degrees of freedom exceeds `chi2`: the regularised upper
// incomplete gamma function Q(dof/2, chi2/2) (Abramowitz and Stegun 26.4). Domain: chi2 >= 0,
// dof > 0, else std::invalid_argument; infinite chi2 gives 0.
double chi_square_tail(double chi2, double dof);

}  // namespace scattermeter
