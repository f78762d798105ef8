// Decisions, for many clusters at once, whether rows in a region may sum them by their series.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/sums/series_kernels.h"

namespace scattermeter {

// The properties of a cluster used in the decision, in one cache line.
struct alignas(64) ClusterTraits {
  float center_mm[3];  // from the centre of the root
  float radius_mm;
  // Weight times the mean of (distance / radius)^(kDegrees[i] + 1), divided by the radius except
  // for degree 1; rounded up.
  float spread[5];
  float weight;       // rounded up
  std::int32_t last;  // index of the highest degree worth summing, -1: none
};

// The region of the rows, and the errors allowed there. Tables are those of KernelBounds, by cell.
struct VerdictRegion {
  float center_mm[3];  // from the centre of the root
  float radius_mm;
  float slack_mm;  // error of distances between centres, beyond 1e-6 of them
  float typical;   // the deciding row is nearer than the centre by this many radii
  float share;     // largest rest of a cluster, in units of the limits
  float nearest_pole_mm, farthest_pole_mm;
  float per_cell_unit;  // of KernelBounds::cell
  const float* need;    // [i][reach][cell]: of a rest, over the limits
  const float* all;     // [cell]: of all the light, over the limits
  const float* tail;    // KernelBounds::tails()
};

// Outputs for each cluster: kVerdictOpen, kVerdictDrop or the index of a degree; the series' rest
// over the limits for the nearest possible row, rounded up; that row's distance to the pole,
// rounded down.
struct Verdicts {
  std::int32_t* verdict;
  float* rest;
  float* nearest_mm;
};
inline constexpr std::int32_t kVerdictOpen = -1, kVerdictDrop = -2;

// A cluster is dropped if it gives less than the share at a distance, which is then stored in
// `nearest_mm`. A series is summed if its rest for the typical row is at most the share, the lowest
// degree that meets this. Precondition: the outputs have room for the next multiple of 16 clusters.
void judge_clusters(const ClusterTraits* traits, std::span<const std::int32_t> nodes,
                    const VerdictRegion& region, const Verdicts& out);

}  // namespace scattermeter
