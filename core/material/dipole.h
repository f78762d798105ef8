// The dipole approximation of diffuse subsurface reflectance.
#pragma once

#include "core/material/medium.h"

namespace scattermeter {

// R(d) and its derivatives, from the paper's eq. 3 to 9 (Jensen et al. 2001, eq. 4):
//   R(d) = alpha'/(4 pi) * sum over i in {r, v} of z_i (1 + x_i) exp(-x_i) / d_i^3,
//   d_i^2 = d^2 + z_i^2,  x_i = sigma_tr d_i,  z_r = 1/sigma_t',  z_v = z_r (1 + 4A/3).
// The kernel belongs to a half-space with isotropic scattering and is a good approximation for
// albedo alpha' near 1 and distances of some z_r or more.
class Dipole {
 public:
  struct Value {
    double r_per_mm2 = 0;        // R
    double d_sigma_s_prime = 0;  // dR / d sigma_s', 1/mm
    double d_sigma_a = 0;        // dR / d sigma_a, 1/mm; finite at sigma_a = 0
  };

  // Throws std::invalid_argument unless sigma_s' > 0, sigma_a >= 0, eta > 0, all finite.
  explicit Dipole(const Medium& medium);

  double reflectance_per_mm2(double distance_mm) const;
  Value with_derivatives(double distance_mm) const;

  // Integral of R over the plane: alpha'/2 (1 + exp(-4A/3 s)) exp(-s), s = sqrt(3 (1 - alpha')).
  double total_reflectance() const;

  double z_r_mm() const { return z_r_mm_; }
  double z_v_mm() const { return z_v_mm_; }
  double sigma_tr_per_mm() const { return sigma_tr_per_mm_; }

 private:
  double sigma_s_prime_ = 0;
  double sigma_a_ = 0;
  double sigma_t_prime_ = 0;
  double albedo_ = 0;
  double mismatch_ = 1;  // A
  double z_r_mm_ = 0;
  double z_v_mm_ = 0;
  double sigma_tr_per_mm_ = 0;
};

}  // namespace scattermeter
