// The choice of clusters for rows in a region: summed by a series, dropped, or opened.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/sums/kernel_bounds.h"
#include "core/sums/source_clusters.h"

namespace scattermeter {

// One number for each quantity of LaneSums: value, z_d_z (the sum of its parts' absolute values),
// decay. Units are those of LaneSums for a total weight of 1.
using PerQuantity = std::array<double, 3>;

// A sphere that contains rows.
struct RowRegion {
  Eigen::Vector3d center_mm;
  double radius_mm;
};

// A cluster that is summed by its series of degree kDegrees[series].
struct AcceptedSeries {
  std::int32_t node;
  std::size_t series;
  double rest;        // bound of the series' remainder for the nearest row, over the limit
  double nearest_mm;  // from that row to the nearest pole
};

// Chooses clusters by the bounds of core/sums/kernel_bounds.h. Thread-safe: the memory of a search
// is in its Workspace. The sources must outlive it.
class ClusterSelection {
 public:
  // The memory of one thread.
  struct Workspace {
    // The limits (one for each medium) that the tables below are for; and by cell of distances, the
    // largest over media and quantities of a series' rest over its limit (by degree and reach), and
    // of all the light over its limit.
    std::vector<PerQuantity> table_limits;
    std::vector<float> need, all;
    // Nodes to be examined: the start of select(); empty afterwards.
    std::vector<std::int32_t> nodes;
    std::vector<std::int32_t> next, verdicts;
    std::vector<float> rests, nearest_mm;
    // Work done so far.
    std::int64_t tests = 0, dropped = 0;
  };

  // Precondition: at least one dipole and one source.
  ClusterSelection(const SourceClusters& sources, std::span<const KernelDipole> dipoles);

  const KernelBounds& bounds() const { return bounds_; }
  double farthest_pole_mm() const { return farthest_pole_mm_; }
  // Light below which errors are absolute instead of relative to a row's light: 1e-30 of that with
  // all light at the row.
  PerQuantity least_light(std::size_t medium) const;

  // Approximate light of the rows in the region: with the clusters' weights at their centres, at
  // the region's centre, minus a fifth for rows in less light. Not a bound.
  std::vector<PerQuantity> estimate_light(const RowRegion& region, Workspace& workspace) const;

  // Tables for these limits (one for each medium), for rows in the region or nearer to the middle
  // of all clusters. They stay valid until other limits are set.
  void build_limit_tables(const std::vector<PerQuantity>& limits, const RowRegion& region,
                          Workspace& workspace) const;

  // Examines the clusters in workspace.nodes and their parts. Each is dropped if it gives less than
  // `share` of the limits to any row of the region; or accepted with the series of the lowest
  // degree whose remainder is at most that for a row nearer than the region's centre by `typical`
  // radii; or else opened, unless it is a leaf or not larger than `smallest_mm`, which go to
  // `open`. Appends to `accepted`, adds bounds of what is dropped to `dropped` (one for each
  // medium), replaces `open`.
  struct Criteria {
    double typical, share, smallest_mm;
  };
  void select(const RowRegion& region, const Criteria& criteria, Workspace& workspace,
              std::vector<AcceptedSeries>& accepted, std::vector<PerQuantity>& dropped,
              std::vector<std::int32_t>& open) const;

 private:
  void judge(const RowRegion& region, const Criteria& criteria, Workspace& workspace) const;

  const SourceClusters& sources_;
  std::size_t media_;
  KernelBounds bounds_;
  double farthest_pole_mm_ = 0;
};

// From a cluster's centre to another point.
inline double distance_mm(const ClusterNode& node, const Eigen::Vector3d& point_mm) {
  const double x = node.center_mm[0] - point_mm.x();
  const double y = node.center_mm[1] - point_mm.y();
  const double z = node.center_mm[2] - point_mm.z();
  return std::sqrt(x * x + y * y + z * z);
}

}  // namespace scattermeter
