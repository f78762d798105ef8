// What the dipole's poles are at most and at least, and what their Taylor series leave out.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/dipole_kernels.h"

namespace scattermeter {

// A point at distance tau from another, at distance rho > tau from the pole, x the cosine between
// the two directions (in four dimensions, the pole's depth being one): psi_c
// (core/dipole_kernels.h) has the terms of degree n in tau
//   sum over m = n, n - 2, .. of a_nm C_m(x) tau^n rho^-(n + 2c + 1) exp(-y),  y = kappa rho,
//   a_nm = Gamma(nu) (nu + m) p_(c+m)(y) (y/2)^(n-m) 2^-m / (((n-m)/2)! Gamma(nu + (n+m)/2 + 1)),
// C_m the Gegenbauer polynomials of nu = c + 1/2 and p_q = psi_q rho^(2q+1) exp(y): Gegenbauer's
// addition theorem for K_nu(kappa w) / w^nu (Watson, Theory of Bessel Functions, 1922, 11.41) with
// the power series of I_(nu+m). No a_nm is negative and |C_m(x)| <= C_m(1), so no term is larger
// than at x = 1; and where |x| <= cosine, none than with each |C_m| at its largest there, which is
// what this returns. Domain: c 0 .. 2, 0 <= n <= 40, y >= 0, cosine 0 .. 1.
double largest_term(int c, int n, double y, double cosine);

// The quantities of LaneSums: value, z_d_z, decay. z_d_z is told by the sum of its two parts'
// absolute values, z psi_1 + z^3 psi_2.
using ThreeBounds = std::array<float, 3>;

// Tables over the distance d of a row from a cluster's centre, in sixteenths of octaves, for a
// weight of 1. An entry is right for all distances of its cell.
class KernelBounds {
 public:
  // Precondition: at least one medium.
  explicit KernelBounds(std::span<const KernelDipole> media);

  static constexpr int kPerOctave = 16;
  static constexpr std::size_t kCells = kPerOctave * 28 + 2;
  // Distances in units of the least z_r, from 2^-6 of them on; beyond the last octave the least is
  // 0 and the rest that of its beginning. The cell is told by exponent and first digits.
  std::size_t cell(double distance_mm) const {
    const auto x = static_cast<float>(distance_mm * per_z_r_);
    const auto bits = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(x) >> 19);
    const std::int64_t i = bits - kCellBits;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, kCells - 1));
  }
  static constexpr int kCellBits = ((127 - 6) << 4) - 1;
  double cells_per_mm() const { return per_z_r_; }  // of the number whose bits tell the cell
  double nearest_pole_mm() const { return nearest_pole_mm_; }  // least z_r
  const ThreeBounds& largest(std::size_t medium, std::size_t cell) const {
    return largest_[medium * kCells + cell];
  }
  const ThreeBounds& least(std::size_t medium, std::size_t cell) const {
    return least_[medium * kCells + cell];
  }

  // How far rows are that a rest is to hold for: up to so many octaves beyond the nearest's cell,
  // the last any. The farther, the more of them look along the cluster.
  static constexpr std::size_t kReaches = 3;
  static std::size_t reach(std::size_t nearest_cell, std::size_t farthest_cell) {
    const std::size_t cells = farthest_cell - nearest_cell;
    return cells <= kPerOctave ? 0 : cells <= 2 * kPerOctave ? 1 : 2;
  }

  // With rho^2 = d^2 + (least z_r)^2: for a row at a distance d that is within `reach` of that
  // cell, a series of degree kDegrees[i] about the centre of a cluster of radius a leaves out at
  // most
  //   (mean of (|D|/a)^(T+1)) a^(T+1) / rho^kFalls[i] rest[quantity] tail,
  // the tail that of a / rho at the cell's lower edge or at any distance of it.
  const ThreeBounds& rest(std::size_t medium, std::size_t i, std::size_t reach,
                          std::size_t cell) const {
    return rest_[((medium * std::size(kDegrees) + i) * kReaches + reach) * kCells + cell];
  }
  // All of a medium and series, by reach and cell.
  const ThreeBounds* rests(std::size_t medium, std::size_t i) const {
    return &rest(medium, i, 0, 0);
  }
  static constexpr std::size_t kTails = 24;  // u in steps of 1/32; from 3/4 on there is no bound
  static constexpr double kLargestRatio = 0.75;
  float tail(std::size_t i, std::size_t reach, std::size_t cell, std::size_t ratio) const {
    return tail_[((i * kReaches + reach) * kCells + cell) * kTails + ratio];
  }
  const float* tails() const { return tail_.data(); }

 private:
  static constexpr int kFirstOctave = -6;
  double nearest_pole_mm_, per_z_r_;
  std::vector<ThreeBounds> largest_, least_, rest_;
  std::vector<float> tail_;
};

}  // namespace scattermeter
