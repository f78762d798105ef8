#include "core/material/dipole.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "core/material/fresnel.h"

namespace scattermeter {
namespace {

// One source of the pair: g(z, kappa, d) = z (1 + x) exp(-x) / rho^3, x = kappa rho,
// rho^2 = d^2 + z^2.
struct Pole {
  double value;
  double d_z;       // dg/dz
  double d_kappa2;  // dg/d(kappa^2): smooth at kappa = 0, unlike dg/d kappa's chain through sqrt
};

Pole pole(double z, double kappa, double d) {
  const double rho2 = d * d + z * z;
  const double rho = std::sqrt(rho2);
  const double x = kappa * rho;
  const double e = std::exp(-x);
  const double inv_rho3 = 1.0 / (rho2 * rho);
  Pole p{};
  p.value = z * (1.0 + x) * e * inv_rho3;
  // d/d rho [(1 + x) exp(-x) rho^-3] = -(kappa^2 rho + 3 (1 + x) / rho) exp(-x) rho^-3, and
  // d rho / dz = z / rho.
  p.d_z = e * inv_rho3 * ((1.0 + x) - z * z * kappa * kappa - 3.0 * (1.0 + x) * z * z / rho2);
  // d/d kappa [(1 + x) exp(-x)] = -kappa rho^2 exp(-x); divide by d kappa^2 / d kappa = 2 kappa.
  p.d_kappa2 = -0.5 * z * e / rho;
  return p;
}

}  // namespace

Dipole::Dipole(const Medium& medium)
    : sigma_s_prime_(medium.sigma_s_prime_per_mm), sigma_a_(medium.sigma_a_per_mm) {
  if (!(sigma_s_prime_ > 0.0) || !(sigma_a_ >= 0.0) || !std::isfinite(sigma_s_prime_) ||
      !std::isfinite(sigma_a_) || !(medium.eta_int_over_ext > 0.0) ||
      !std::isfinite(medium.eta_int_over_ext)) {
    std::ostringstream out;
    out << "Dipole: sigma_s' = " << sigma_s_prime_ << ", sigma_a = " << sigma_a_
        << " per mm, eta = " << medium.eta_int_over_ext;
    throw std::invalid_argument(out.str());
  }
  sigma_t_prime_ = sigma_s_prime_ + sigma_a_;
  albedo_ = sigma_s_prime_ / sigma_t_prime_;
  mismatch_ = boundary_mismatch(medium.eta_int_over_ext);
  z_r_mm_ = 1.0 / sigma_t_prime_;
  z_v_mm_ = z_r_mm_ * (1.0 + 4.0 / 3.0 * mismatch_);
  sigma_tr_per_mm_ = std::sqrt(3.0 * sigma_a_ * sigma_t_prime_);
}

double Dipole::reflectance_per_mm2(double distance_mm) const {
  return albedo_ / (4.0 * std::numbers::pi) *
         (pole(z_r_mm_, sigma_tr_per_mm_, distance_mm).value +
          pole(z_v_mm_, sigma_tr_per_mm_, distance_mm).value);
}

Dipole::Value Dipole::with_derivatives(double distance_mm) const {
  const Pole r = pole(z_r_mm_, sigma_tr_per_mm_, distance_mm);
  const Pole v = pole(z_v_mm_, sigma_tr_per_mm_, distance_mm);
  const double sum = r.value + v.value;
  // z_i = c_i / sigma_t', so dz_i / d sigma_t' = -z_i / sigma_t'; kappa^2 = 3 sigma_a sigma_t'.
  const double d_sigma_t = -(r.d_z * z_r_mm_ + v.d_z * z_v_mm_) / sigma_t_prime_;
  const double d_kappa2 = r.d_kappa2 + v.d_kappa2;
  const double scale = 1.0 / (4.0 * std::numbers::pi);
  const double t2 = sigma_t_prime_ * sigma_t_prime_;
  Value out;
  out.r_per_mm2 = scale * albedo_ * sum;
  out.d_sigma_s_prime =
      scale * (sigma_a_ / t2 * sum + albedo_ * (d_sigma_t + 3.0 * sigma_a_ * d_kappa2));
  out.d_sigma_a = scale * (-sigma_s_prime_ / t2 * sum +
                           albedo_ * (d_sigma_t + 3.0 * (sigma_t_prime_ + sigma_a_) * d_kappa2));
  return out;
}

double Dipole::total_reflectance() const {
  const double s = std::sqrt(3.0 * sigma_a_ / sigma_t_prime_);
  return 0.5 * albedo_ * (1.0 + std::exp(-4.0 / 3.0 * mismatch_ * s)) * std::exp(-s);
}

}  // namespace scattermeter
