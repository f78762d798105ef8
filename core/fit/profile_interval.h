// Confidence intervals from the profile likelihood.
#pragma once

#include "core/fit/dipole_solver.h"

namespace scattermeter {

struct Interval {
  double low = 0;
  double high = 0;
};

// The values of a coefficient (1/mm) whose best chi-square, all other parameters free, exceeds the
// optimum's by at most `rise`: 3.84 for 95 % for the image's chi-square as it is. `std_per_mm`: the
// standard deviation by this chi-square at the optimum; the first step is sqrt(rise) times it, and
// ends are located to half a hundredth of it, or of the root of the rise. The lower end is at least
// 0. An end that cannot be bracketed within 1000 steps is returned as 0 or +infinity.
Interval profile_interval(const DipoleSolver& solver, const DipoleSolver::Point& best,
                          DipoleSolver::Coefficient coefficient, double std_per_mm, double rise);

}  // namespace scattermeter
