// What the search by transport takes from the dipole: the shots' rows and a smooth pilot image.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/estimation.h"
#include "core/fit/scattering_equation.h"
#include "core/transport/scattering_rows.h"

namespace scattermeter {

// The dipole's image of the medium at `at` with its derivatives, at scale 1; variance stays empty.
// weights: W on the knots, one row of the image each.
ScatteringImage dipole_pilot(const WeightMatrix& weights, const DistanceKnots& knots,
                             const ScatteringPoint& at, double eta_int_over_ext);

// Monte Carlo variances proportional to light over area, with the sum of `noisy_variance`: weights
// must not depend on the noise of paths. l (negative counts as 0) and area_mm2: of the rows.
// Precondition: some l is positive.
Eigen::VectorXd smooth_path_variance(const Eigen::VectorXd& l, const std::vector<double>& area_mm2,
                                     const Eigen::VectorXd& noisy_variance);

// The dipole's system for the search: with the light by way of the plane, which paths simulate, and
// without the shifts of single shots: with these, the search for faint materials ends with scale
// and eta far off. Its first nuisance is gamma (PhaseFunction::gamma()), with a column of zeros.
DenseSystem system_of_paths(const DipoleSystem& dipole, double gamma_std);

}  // namespace scattermeter
