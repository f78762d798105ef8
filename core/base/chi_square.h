// The tail of the chi-square distribution.
#pragma once

namespace scattermeter {

// Probability that a chi-square of `dof` degrees of freedom exceeds `chi2`: the regularised upper
// incomplete gamma function Q(dof/2, chi2/2) (Abramowitz and Stegun 26.4). Domain: chi2 >= 0,
// dof > 0, else std::invalid_argument; infinite chi2 gives 0.
double chi_square_tail(double chi2, double dof);

// A computed sum of squares as a chi-square: 0 where rounding has made it negative, and infinite
// where it is not a number, so that a failed computation never passes for a perfect fit.
double as_chi_square(double sum);

}  // namespace scattermeter
