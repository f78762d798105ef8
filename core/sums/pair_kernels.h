// Pairs of squared distance and power from sources to one site, and their sums by distance, many at
// a time. The digits do not depend on the instruction set.
#pragma once

#include <cstdint>

namespace scattermeter {

// Points about the centroid of a source, mm, and their powers, sr. Unused lanes are zero.
template <int kLanes>
struct SourcePoints {
  alignas(16) float x[kLanes] = {};
  float y[kLanes] = {}, z[kLanes] = {}, power[kLanes] = {};
};

// Points, `scale` times as far from a centroid at (x, y, z), with `of_power` times their powers
// plus `even` times given ones. Lengths in mm.
template <int kLanes>
struct PlacedPoints {
  const SourcePoints<kLanes>* points;
  float x, y, z;
  float scale, of_power, even;
};

// The pairs of n sets of three points: 3 n values d2 (mm^2) and power (sr), and one lane beyond
// that is overwritten. `even` does not count.
void three_point_pairs(const PlacedPoints<4>* sets, int n, float* d2, float* power);
// The same of six points, with two lanes beyond; even: the powers (8 lanes) that `even` multiplies.
void six_point_pairs(const PlacedPoints<8>* sets, int n, const float* even, float* d2,
                     float* power);

// Clusters by power (sr), position of the centroid from the site's centre (mm) and covariance
// (mm^2).
struct ClusterBatch {
  static constexpr int kSize = 16;
  alignas(64) float x[kSize] = {};
  float y[kSize] = {}, z[kSize] = {}, power[kSize] = {};
  float xx[kSize] = {}, xy[kSize] = {}, xz[kSize] = {}, yy[kSize] = {}, yz[kSize] = {},
        zz[kSize] = {};
};
inline constexpr int kClusterPairs = 4 * ClusterBatch::kSize;
// Each cluster, of a site with the covariance (xx, xy, xz, yy, yz, zz) `site` in mm^2, as four
// pairs that keep mean and covariance of the difference of two independent points: kClusterPairs
// values d2 and power.
void cluster_pairs(const ClusterBatch& clusters, const float* site, float* d2, float* power);

// Knots in s = d^2 + s0 by the bit pattern of s (OctaveBins in core/diffusion/distance_bins.h).
struct OctaveScale {
  float s0;               // mm^2
  int shift;              // of the pattern, to the number of a knot
  std::int32_t first;     // number of the first knot
  std::int32_t last_bin;  // from the first; what lies beyond counts there
};
// Shares each power between the knots on both sides: sums[2 i] += that of knot i, sums[2 i + 1] +=
// that of knot i + 1. Thus pairs in neighbouring bins do not wait for each other. d2 and power are
// read up to the next multiple of 16 values.
void add_octave_pairs(const OctaveScale& scale, const float* d2, const float* power, int n,
                      float* sums);

}  // namespace scattermeter
