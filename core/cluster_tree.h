// Points parted into clusters, clusters into clusters.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/cluster_planes.h"

namespace scattermeter {

struct ClusterNode {
  double center_mm[3];          // centroid of the weight
  double radius_mm;             // no point is farther from it; 0: all coincide
  double weight;                // relative to that of all
  std::array<float, 5> spread;  // mean of (distance / radius)^(kDegrees[i] + 1), rounded up
  std::int32_t first, last;     // points [first, last)
  std::int32_t left, right;     // -1: a leaf
  std::int32_t series;          // place of frame and coefficients; -1: none
  std::int32_t bucket;          // of leaves: the node about whose centre the points are told
  std::int32_t plane;           // that splitting found it to lie in; -1: none
  bool planar;
};

// Where a plane holds many of a cluster's points these are told from the others; else boxes are
// halved at their longest side, until kLeaf points are left, or points that coincide.
struct ClusterTree {
  static constexpr std::int32_t kLeaf = 8;
  // Leaves of up to so many points are told about one centre, so that neighbours are summed at
  // once.
  static constexpr std::int32_t kBucket = 64;

  // Of points whose weights are > 0, at least one; puts them in the order of the leaves. Without
  // what a series adds to a node: series -1, spread and planar unset. Parallel; the same tree for
  // any number of threads.
  explicit ClusterTree(std::vector<WeightedPoint>& points);

  std::vector<ClusterNode> nodes;  // the root first, each before its parts
  std::vector<ClusterPlane> planes;
};

}  // namespace scattermeter
