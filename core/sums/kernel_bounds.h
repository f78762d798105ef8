// Upper and lower bounds of the dipole's poles, and bounds of the remainders of their Taylor
// series.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/sums/dipole_kernels.h"
#include "core/sums/series_bounds.h"

namespace scattermeter {

// The quantities of LaneSums: value, z_d_z, decay. For z_d_z it is the sum of its two parts'
// absolute values, z psi_1 + z^3 psi_2, that is bounded.
using ThreeBounds = std::array<float, 3>;

// Tables over the distance d of a row from a cluster's centre, in sixteenths of octaves, for a
// weight of 1. An entry holds for all distances of its cell.
class KernelBounds {
 public:
  // Precondition: at least one medium.
  explicit KernelBounds(std::span<const KernelDipole> media);

  static constexpr std::size_t kSeries = std::size(kDegrees);
  static constexpr int kPerOctave = 16;
  static constexpr std::size_t kCells = kPerOctave * 28 + 2;
  // Distances in units of the least z_r, from 2^-6 of them on; beyond the last octave the lower
  // bound is 0 and the remainder that at its beginning. The cell comes from the exponent and the
  // first digits.
  std::size_t cell(double distance_mm) const {
    const auto x = static_cast<float>(distance_mm * per_z_r_);
    const auto bits = static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(x) >> 19);
    const std::int64_t i = bits - kCellBits;
    return static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, kCells - 1));
  }
  static constexpr int kCellBits = ((127 - 6) << 4) - 1;
  double cells_per_mm() const { return per_z_r_; }  // of the number whose bits are the cell
  double nearest_pole_mm() const { return nearest_pole_mm_; }  // least z_r
  const ThreeBounds& largest(std::size_t medium, std::size_t cell) const {
    return largest_[medium * kCells + cell];
  }
  const ThreeBounds& least(std::size_t medium, std::size_t cell) const {
    return least_[medium * kCells + cell];
  }

  // The range of row distances for which a remainder holds: up to one or two octaves beyond the
  // cell of the nearest row; the last, any distance. Farther rows see the cluster more obliquely.
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
    return rest_[((medium * kSeries + i) * kReaches + reach) * kCells + cell];
  }
  // All of a medium and series, by reach and cell.
  const ThreeBounds* rests(std::size_t medium, std::size_t i) const {
    return &rest(medium, i, 0, 0);
  }
  static constexpr std::size_t kTails = SeriesBounds::kRatios;
  static constexpr double kLargestRatio = 0.75;
  float tail(std::size_t i, std::size_t reach, std::size_t cell, std::size_t ratio) const {
    return tail_[((i * kReaches + reach) * kCells + cell) * kTails + ratio];
  }
  const float* tails() const { return tail_.data(); }

 private:
  static constexpr int kFirstOctave = -6;
  // Edges of a cell, a little beyond since cells are found in single precision; infinity for the
  // last.
  double lower_edge_mm(std::size_t cell) const;
  double upper_edge_mm(std::size_t cell) const;
  // Enter one medium (of index m) and cell into the tables.
  void bound_values(const KernelDipole& medium, std::size_t m, std::size_t cell);
  void bound_rests(const KernelDipole& medium, std::size_t m, std::size_t cell);
  // Carry the bounds of single cells to all distances of each reach.
  void cover_reaches_of_rests(std::size_t m, std::size_t i);
  void cover_reaches_of_tails(std::size_t i);

  double nearest_pole_mm_, per_z_r_;
  std::vector<ThreeBounds> largest_, least_, rest_;
  std::vector<float> tail_;
};

}  // namespace scattermeter
