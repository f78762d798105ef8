// A binary tree of clusters of weighted points.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/sums/cluster_planes.h"

namespace scattermeter {

struct ClusterNode {
  double center_mm[3];          // centroid of the weight
  double radius_mm;             // no point is farther from it; 0: all coincide
  double weight;                // relative to that of all points
  std::array<float, 5> spread;  // mean of (distance / radius)^(kDegrees[i] + 1), rounded up
  std::int32_t first, last;     // points [first, last)
  std::int32_t left, right;     // -1: a leaf
  std::int32_t series;          // index of frame and coefficients; -1: none
  std::int32_t bucket;          // of leaves: the node whose centre the points are relative to
  std::int32_t plane;           // the plane that contains all its points; -1: none
  bool planar;
};

// If a plane contains many of a cluster's points, it is split into these and the others; otherwise
// its box is halved at the longest side, until kLeaf points are left or all points coincide.
struct ClusterTree {
  static constexpr std::int32_t kLeaf = 8;
  // The leaves of a cluster of up to this many points have their points relative to one centre, so
  // that neighbouring leaves are summed together.
  static constexpr std::int32_t kBucket = 64;

  // Sorts the points into the order of the leaves. Members that belong to the series are not set:
  // series is -1, spread and planar are 0. Precondition: at least one point, all weights > 0.
  // Parallel; the same tree for any number of threads.
  explicit ClusterTree(std::vector<WeightedPoint>& points);

  std::vector<ClusterNode> nodes;  // the root first, each before its parts
  std::vector<ClusterPlane> planes;
};

}  // namespace scattermeter
