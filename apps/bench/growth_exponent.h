// How fast something grows.
#pragma once

#include <vector>

namespace scattermeter::apps {

// p of y = const x^p, by least squares of the logarithms; NaN where there are fewer than two x. All
// must be above 0.
double growth_exponent(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace scattermeter::apps
