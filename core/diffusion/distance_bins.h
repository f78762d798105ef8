// Bins of squared distances with linear weights.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "core/sums/pair_kernels.h"

namespace scattermeter {

// Both kinds of bins take pairs (d^2, weight) and share each weight between the two knots around d
// so that a function that is linear between knots is summed exactly. Sum: the number type of sums,
// of which there are sums().

// Knots d'_i = i * width: the paper's quantised distances (eq. 17 to 25).
class UniformBins {
 public:
  using Sum = double;
  UniformBins(double width_mm, double max_distance_mm)
      : width_mm_(width_mm),
        inv_width_(1.0F / static_cast<float>(width_mm)),
        n_(static_cast<int>(std::ceil(max_distance_mm / width_mm)) + 2) {}

  int size() const { return n_; }
  int sums() const { return n_; }
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
  OctaveBins(double s0_mm2, double max_distance_mm, int bits) {
    scale_.s0 = static_cast<float>(std::exp2(std::floor(std::log2(s0_mm2))));
    scale_.shift = 23 - bits;
    const auto number = [&](float s) { return std::bit_cast<std::int32_t>(s) >> scale_.shift; };
    scale_.first = number(scale_.s0);
    const float top = static_cast<float>(max_distance_mm * max_distance_mm * 1.0001) + scale_.s0;
    scale_.last_bin = number(top) - scale_.first;
  }

  int size() const { return scale_.last_bin + 2; }
  double s0_mm2() const { return static_cast<double>(scale_.s0); }
  // s at knot i, mm^2.
  double knot_s_mm2(int i) const {
    return static_cast<double>(std::bit_cast<float>((scale_.first + i) << scale_.shift));
  }
  // Two for each knot i: what pairs beyond it share with it, and what they share with the next.
  int sums() const { return 2 * size(); }
  static float of_knot(const float* sums, int i) {
    return i > 0 ? sums[2 * i] + sums[2 * i - 1] : sums[0];
  }
  // d2_mm2 and weight are read up to the next multiple of 16 values.
  void add(const float* d2_mm2, const float* weight, int n, float* sums) const {
    add_octave_pairs(scale_, d2_mm2, weight, n, sums);
  }

 private:
  OctaveScale scale_;
};

}  // namespace scattermeter
