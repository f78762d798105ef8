// Whether clusters of points may be summed by their series for rows at a place, many at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/dipole_kernels.h"

namespace scattermeter {

// What is told of a cluster, in a line of the cache.
struct alignas(64) ClusterTraits {
  float center_mm[3];  // from the middle of them all
  float radius_mm;
  // Weight times the mean of (distance / radius)^(kDegrees[i] + 1), over the radius except for
  // degree 1; rounded up.
  float spread[5];
  float weight;       // rounded up
  std::int32_t last;  // highest of its series that is worth summing, -1: none
};

// Where rows are, and what is allowed there. Tables are those of KernelBounds, by cell.
struct VerdictPlace {
  float center_mm[3];  // from the middle of all clusters
  float radius_mm;
  float slack_mm;  // error of distances between centres, beyond 1e-6 of them
  float typical;   // the row that decides is nearer than the middle by so many radii
  float share;     // largest rest of a cluster, in units of the limits
  float nearest_pole_mm, farthest_pole_mm;
  float per_cell_unit;  // of KernelBounds::cell
  const float* need;    // [i][reach][cell]: of a rest, over the limits
  const float* all;     // [cell]: of all the light, over the limits
  const float* tail;    // KernelBounds::tails()
};

// By cluster: kVerdictOpen, kVerdictDrop, or which series; its rest over the limits for the nearest
// row there may be, rounded up; that row's distance to the pole, rounded down.
struct Verdicts {
  std::int32_t* verdict;
  float* rest;
  float* nearest_mm;
};
inline constexpr std::int32_t kVerdictOpen = -1, kVerdictDrop = -2;

// Dropped is what gives less than the share at the distance `nearest_mm` told then; a series is
// summed if its rest for the typical row is at most the share, the lowest that will do. Outputs
// have room for the next multiple of 16.
void judge_clusters(const ClusterTraits* traits, std::span<const std::int32_t> nodes,
                    const VerdictPlace& place, const Verdicts& out);

}  // namespace scattermeter
