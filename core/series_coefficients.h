// The coefficients of a cluster's series (core/dipole_kernels.h).
#pragma once

#include "core/dipole_kernels.h"

namespace scattermeter {

// From its raw moments up to that degree, for a weight of 1 in all: out[coefficient_place(n, m)]
// and what follows is (-1/2)^m / (m! i! j! l!) times the mean of |D|^2m x^i y^j z^l, i + j + l =
// n - 2m, n = 0 .. degree. weight: that of the points, > 0; out: room for
// coefficient_place(degree + 1, 0).
void series_coefficients(const KernelMoments& moments, bool planar, int degree, double weight,
                         float* out);

}  // namespace scattermeter
