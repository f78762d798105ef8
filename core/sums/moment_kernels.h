// Moments of a cluster of points, computed for many points at once.
#pragma once

#include <cstddef>

#include "core/sums/series_kernels.h"

namespace scattermeter {

// Moments of points about a centre, in a frame and in units of a radius: raw[i] is the sum of
// weight times the i-th monomial, monomials of degree 0 .. `degree` in the order of
// core/sums/series_kernels.h;
// absolute[i] the sum of weight |D|^(kDegrees[i] + 1).
struct KernelMoments {
  float raw[165];
  float absolute[5];
};
void sum_moments(const double* x_mm, const double* y_mm, const double* z_mm, const float* weight,
                 std::size_t count, const double* center_mm, double radius_mm, const float* frame,
                 bool planar, int degree, KernelMoments& out);

}  // namespace scattermeter
