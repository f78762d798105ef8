#include "core/diffusion/dipole_curve.h"

#include <cmath>

#include "core/material/dipole.h"

namespace scattermeter {

Medium medium_of(double u, double q, double eta_int_over_ext) {
  const double sigma_t = std::exp(u);
  return {(1.0 - q) * sigma_t, q * sigma_t, eta_int_over_ext};
}

DipoleCurve dipole_curve(const DistanceKnots& knots, double u, double q, double eta_int_over_ext) {
  const double sigma_t = std::exp(u);
  const Dipole dipole(medium_of(u, q, eta_int_over_ext));
  DipoleCurve c{Eigen::VectorXd(knots.size()), Eigen::VectorXd(knots.size()),
                Eigen::VectorXd(knots.size())};
  for (Eigen::Index i = 0; i < knots.size(); ++i) {
    const Dipole::Value v = dipole.with_derivatives(knots.knots_mm()[static_cast<std::size_t>(i)]);
    c.r[i] = v.r_per_mm2;
    // sigma_s' = (1 - q) sigma_t', sigma_a = q sigma_t', d sigma_t' / du = sigma_t'.
    c.d_u[i] = sigma_t * ((1.0 - q) * v.d_sigma_s_prime + q * v.d_sigma_a);
    c.d_q[i] = sigma_t * (v.d_sigma_a - v.d_sigma_s_prime);
  }
  return c;
}

}  // namespace scattermeter
