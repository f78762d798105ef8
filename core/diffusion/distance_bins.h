// Bins of squared distances with linear weights.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace scattermeter {

// Both kinds of bins take pairs (d^2, weight) and share each weight between the two knots around d
// so that a function that is linear between knots is summed exactly. Sum: the number type of a
// knot's sum.
inline constexpr int kPairsAtOnce = 256;  // largest n of add()

// Knots d'_i = i * width: the paper's quantised distances (eq. 17 to 25).
class UniformBins {
 public:
  using Sum = double;
  UniformBins(double width_mm, double max_distance_mm)
      : width_mm_(width_mm),
        inv_width_(1.0F / static_cast<float>(width_mm)),
        n_(static_cast<int>(std::ceil(max_distance_mm / width_mm)) + 2) {}

  int size() const { return n_; }
  double knot_mm(int i) const { return i * width_mm_; }
  void add(float d2_mm2, float weight, double* sums) const {
    const float x = std::sqrt(d2_mm2) * inv_width_;
    const int i = static_cast<int>(x);
    // beta of eq. 19 is 1 - t.
    const float t = x - static_cast<float>(i);
    sums[i] += static_cast<double>(weight * (1.0F - t));
    sums[i + 1] += static_cast<double>(weight * t);
  }
  void add(const float* d2_mm2, const float* weight, int n, double* sums) const {
    for (int k = 0; k < n; ++k) add(d2_mm2[k], weight[k], sums);
  }

 private:
  double width_mm_;
  float inv_width_;
  int n_;
};

// Knots in s = d^2 + s0, evenly spaced inside each octave of s (2^kBits per octave): the bit
// pattern of a float s is the position, so that no root and no logarithm is needed. The step is at
// most 2^-kBits of s; R as a function of d^2 falls no faster than s^-1.5 where s0 <= z_r^2, so
// linear interpolation is relatively wrong by at most (15/32) 4^-kBits: 1.1e-4 for 6, 7e-6 for 8.
// Sums are in single precision: with thousands of pairs in a bin, rounding is about 1e-6 of its
// sum.
class OctaveBins {
 public:
  using Sum = float;
  // s0 is rounded down to a power of two, so that the first knot is at d = 0.
  OctaveBins(double s0_mm2, double max_distance_mm, int bits)
      : s0_(static_cast<float>(std::exp2(std::floor(std::log2(s0_mm2))))),
        shift_(23 - bits),
        fraction_(1.0F / static_cast<float>(1U << (23 - bits))) {
    first_ = std::bit_cast<std::uint32_t>(s0_) >> shift_;
    const float top = static_cast<float>(max_distance_mm * max_distance_mm * 1.0001) + s0_;
    n_ = static_cast<int>((std::bit_cast<std::uint32_t>(top) >> shift_) - first_) + 2;
  }

  int size() const { return n_; }
  double s0_mm2() const { return static_cast<double>(s0_); }
  // s at knot i, mm^2.
  double knot_s_mm2(int i) const {
    return static_cast<double>(
        std::bit_cast<float>((first_ + static_cast<std::uint32_t>(i)) << shift_));
  }
  void add(float d2_mm2, float weight, float* sums) const { add(&d2_mm2, &weight, 1, sums); }
  void add(const float* d2_mm2, const float* weight, int n, float* sums) const {
    // Bins first, so that this loop is vectorised.
    std::array<std::int32_t, kPairsAtOnce> at;
    std::array<float, kPairsAtOnce> to_next;
    const auto mask = static_cast<std::int32_t>((1U << shift_) - 1U);
    for (int k = 0; k < n; ++k) {
      const auto position = std::bit_cast<std::int32_t>(d2_mm2[k] + s0_);
      // Whatever lies beyond the longest distance, by rounding, counts there.
      at[static_cast<std::size_t>(k)] =
          std::min((position >> shift_) - static_cast<std::int32_t>(first_), n_ - 2);
      to_next[static_cast<std::size_t>(k)] =
          weight[k] * (static_cast<float>(position & mask) * fraction_);
    }
    for (int k = 0; k < n; ++k) {
      float* sum = sums + at[static_cast<std::size_t>(k)];
      const float share = to_next[static_cast<std::size_t>(k)];
      sum[0] += weight[k] - share;
      sum[1] += share;
    }
  }

 private:
  float s0_;
  int shift_;
  float fraction_;
  std::uint32_t first_;
  int n_;
};

}  // namespace scattermeter
