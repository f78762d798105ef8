// The dipole on the knots, in the parameters of the fit.
#pragma once

#include <Eigen/Core>

#include "core/diffusion/distance_weights.h"
#include "core/material/medium.h"

namespace scattermeter {

// u = log sigma_t' (sigma_t' in 1/mm) and q = 1 - alpha' decouple: u sets the scale of distances, q
// how fast the far tail falls. Both are of order one whatever the unit of length; q = 0 means no
// absorption.
Medium medium_of(double u, double q, double eta_int_over_ext);

// R on the knots (1/mm^2) and its derivatives by u and q.
struct DipoleCurve {
  Eigen::VectorXd r, d_u, d_q;
};

// Domain: finite u, 0 <= q < 1, eta > 0 (std::invalid_argument from Dipole otherwise).
DipoleCurve dipole_curve(const DistanceKnots& knots, double u, double q, double eta_int_over_ext);

}  // namespace scattermeter
