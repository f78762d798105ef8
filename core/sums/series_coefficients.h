// The coefficients of a cluster's series (core/sums/series_kernels.h).
#pragma once

#include "core/sums/moment_kernels.h"

namespace scattermeter {

// Computes them from the raw moments up to `degree`, for a total weight of 1: out from
// coefficient_index(n, m) on is (-1/2)^m / (m! i! j! l!) times the mean of |D|^2m x^i y^j z^l,
// i + j + l = n - 2m, n = 0 .. degree. weight is that of the points. Preconditions: weight > 0; out
// has room for coefficient_index(degree + 1, 0).
void series_coefficients(const KernelMoments& moments, bool planar, int degree, double weight,
                         float* out);

}  // namespace scattermeter
