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

// Largest n-th derivative by arc length, over n!, of psi_c (core/dipole_kernels.h; c 0 .. 2) at a
// distance rho from the pole, times rho^(n + 2c + 1) exp(y), y = kappa rho: that along the line
// through the pole, a polynomial in y. For kappa = 0 it is the value at 1 of a Gegenbauer
// polynomial, which is the largest; for kappa > 0 a dense search over directions finds none larger
// (tests/core/kernel_bounds_test.cc). Domain: c 0 .. 2, n >= 0, y >= 0.
double largest_derivative(int c, int n, double y);

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
    const std::int64_t i = bits - (std::int64_t{127 + kFirstOctave} << 4) + 1;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, kCells - 1));
  }
  double nearest_pole_mm() const { return nearest_pole_mm_; }  // least z_r
  const ThreeBounds& largest(std::size_t medium, std::size_t cell) const {
    return largest_[medium * kCells + cell];
  }
  const ThreeBounds& least(std::size_t medium, std::size_t cell) const {
    return least_[medium * kCells + cell];
  }

  // With rho^2 = d^2 + (least z_r)^2: a series of degree kDegrees[i] about the centre of a cluster
  // of radius u rho leaves out at most (mean of (|D|/a)^(T+1)) u^(T+1) rest[quantity] tail.
  const ThreeBounds& rest(std::size_t medium, std::size_t i, std::size_t cell) const {
    return rest_[(medium * std::size(kDegrees) + i) * kCells + cell];
  }
  static constexpr std::size_t kTails = 24;  // u in steps of 1/32; from 3/4 on there is no bound
  static constexpr double kLargestRatio = 0.75;
  float tail(std::size_t i, std::size_t cell, std::size_t ratio) const {
    return tail_[(i * kCells + cell) * kTails + ratio];
  }

 private:
  static constexpr int kFirstOctave = -6;
  double nearest_pole_mm_, per_z_r_;
  std::vector<ThreeBounds> largest_, least_, rest_;
  std::vector<float> tail_;
};

}  // namespace scattermeter
