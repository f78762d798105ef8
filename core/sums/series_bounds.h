// Bounds of the terms of the Taylor series of a dipole's pole, for any medium.
#pragma once

#include <array>
#include <cstddef>

#include "core/sums/series_kernels.h"

namespace scattermeter {

// A point at distance tau from another, at distance rho > tau from the pole, x the cosine between
// the two directions (in four dimensions, the pole's depth being one): psi_c
// (core/sums/series_kernels.h) has the terms of degree n in tau
//   sum over m = n, n - 2, .. of a_nm C_m(x) tau^n rho^-(n + 2c + 1) exp(-y),  y = kappa rho,
//   a_nm = Gamma(nu) (nu + m) p_(c+m)(y) (y/2)^(n-m) 2^-m / (((n-m)/2)! Gamma(nu + (n+m)/2 + 1)),
// C_m the Gegenbauer polynomials of nu = c + 1/2 and p_q = psi_q rho^(2q+1) exp(y): Gegenbauer's
// addition theorem for K_nu(kappa w) / w^nu (Watson, Theory of Bessel Functions, 1922, 11.41) with
// the power series of I_(nu+m). No a_nm is negative and |C_m(x)| <= C_m(1), so no term is larger
// than at x = 1; and where |x| <= cosine, none is larger than with each |C_m| at its largest there;
// this bound is returned. Domain: c 0 .. 2, 0 <= n <= 40, y >= 0, cosine 0 .. 1.
double largest_term(int c, int n, double y, double cosine);

// Tables of these bounds over the depth y = kappa rho and the angle between the direction of a row
// and that of its pole.
struct SeriesBounds {
  static constexpr std::size_t kDepths = 32;
  static constexpr std::size_t kAngles = 32;
  // The ratio u = tau / rho in steps of 1/32: entry i holds up to (i + 1) / 32, at most 3/4.
  static constexpr std::size_t kRatios = 24;

  // Cells of y: up to 2^-6, then halves of octaves; largest_depth is a cell's upper edge. The cell
  // is not limited to kDepths.
  static double largest_depth(std::size_t depth_cell);
  static std::size_t depth_cell(double y);
  // Cells of the angle (rad), limited to kAngles: entries hold for the cell and all larger angles.
  static std::size_t angle_cell(double angle_rad);

  template <class T>
  using OverDegrees = std::array<T, std::size(kDegrees)>;
  // The largest term of degree kDegrees[i] + 1 without its exp(-y): [i][c][depth][angle].
  OverDegrees<std::array<std::array<std::array<double, kAngles>, kDepths>, 3>> first;
  // The sum of it and of all terms of higher degree, over it: [i][depth][angle][ratio], for any c.
  OverDegrees<std::array<std::array<std::array<float, kRatios>, kAngles>, kDepths>> tail;
};

// Made at the first call.
const SeriesBounds& series_bounds();

}  // namespace scattermeter
