// A tree of clusters of weighted points, each with the coefficients of its series.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/sums/cluster_tree.h"
#include "core/sums/cluster_verdicts.h"
#include "core/sums/dipole_kernels.h"
#include "core/sums/series_kernels.h"

namespace scattermeter {

// A binary tree (core/sums/cluster_tree.h) over the points with weights > 0; others are left out.
// Inner clusters hold the coefficients of their series (core/sums/series_kernels.h) up to the given
// degree, unless their radius exceeds kLargestShare of the root's: rows on the same body are rarely
// far enough from these.
class SourceClusters {
 public:
  static constexpr double kLargestShare = 0.4;

  using Node = ClusterNode;

  // Domain: as many weights as points, all finite, weights >= 0 (std::invalid_argument naming the
  // first that is not); largest_degree one of kDegrees. Parallel; the same tree for any number of
  // threads.
  SourceClusters(std::span<const Eigen::Vector3d> points_mm, std::span<const double> weights,
                 int largest_degree = kLargestDegree);

  bool empty() const { return nodes_.empty(); }
  std::size_t size() const { return x_mm_.size(); }   // points of weight > 0
  std::size_t left_out() const { return left_out_; }  // points of weight 0
  double weight() const { return weight_; }           // of all
  int largest_degree() const { return largest_degree_; }
  const std::vector<Node>& nodes() const { return nodes_; }       // the root first
  const ClusterTraits* traits() const { return traits_.data(); }  // of all nodes
  KernelCluster cluster(const Node& node) const;                  // precondition: node.series >= 0
  // Points [first, last) of one bucket.
  KernelPoints points(std::int32_t bucket, std::int32_t first, std::int32_t last) const;
  // As add_point_sums, but in double precision.
  void add_exact_sums(std::int32_t first, std::int32_t last, std::span<const KernelDipole> media,
                      const RowLanes& rows, std::span<LaneSums> sums) const;

 private:
  friend class ClusterBuilder;
  std::size_t left_out_ = 0;
  double weight_ = 0;
  int largest_degree_;
  std::vector<Node> nodes_;
  std::vector<ClusterTraits> traits_;
  std::vector<double> x_mm_, y_mm_, z_mm_;
  std::vector<float> weights_;                // relative to that of all
  std::vector<float> dx_mm_, dy_mm_, dz_mm_;  // from the bucket's centre
  std::unique_ptr<float[]> series_;           // frames (9) and coefficients
};

}  // namespace scattermeter
