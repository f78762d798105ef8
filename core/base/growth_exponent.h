// Exponent of a power law.
#pragma once

#include <vector>

namespace scattermeter {

// p of y = const x^p by least squares of the logarithms; NaN for fewer than two different x.
// Precondition: all values are above 0. Throws std::invalid_argument for different lengths.
double growth_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace scattermeter
