#include "core/sums/source_clusters.h"

#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

namespace scattermeter {
namespace {

struct WeightedPoints {
  std::vector<Eigen::Vector3d> at;
  std::vector<double> weight;
};

// On a tilted plane, or in space.
WeightedPoints random_points(std::size_t n, bool planar) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  WeightedPoints p;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    p.at.emplace_back(5.0 + x, y, planar ? 0.5 * x - 0.25 * y : z);
    p.weight.push_back(i % 10 == 9 ? 0.0 : 1.0 + z);
  }
  return p;
}

TEST(SourceClusters, LeavesHoldEveryPointAndClustersTheirMembers) {
  const WeightedPoints p = random_points(1000, false);
  const SourceClusters tree(p.at, p.weight);
  EXPECT_EQ(tree.size(), 900U);
  EXPECT_EQ(tree.left_out(), 100U);
  double all = 0.0;
  for (const double w : p.weight) all += w;
  EXPECT_NEAR(tree.weight(), all, 1e-9);
  double in_leaves = 0.0;
  std::int32_t points = 0;
  for (const auto& node : tree.nodes()) {
    if (node.left < 0) {
      const KernelPoints leaf = tree.points(node.bucket, node.first, node.last);
      const auto& bucket = tree.nodes()[static_cast<std::size_t>(node.bucket)];
      EXPECT_LE(bucket.first, node.first);
      EXPECT_GE(bucket.last, node.last);
      EXPECT_LE(bucket.last - bucket.first, ClusterTree::kBucket);
      EXPECT_LE(leaf.count, static_cast<std::size_t>(ClusterTree::kLeaf));
      points += static_cast<std::int32_t>(leaf.count);
      for (std::size_t i = 0; i < leaf.count; ++i) {
        in_leaves += double(leaf.weight[i]);
        EXPECT_LE(std::hypot(leaf.x_mm[i], leaf.y_mm[i], leaf.z_mm[i]),
                  bucket.radius_mm * (1.0 + 1e-6));
      }
    } else {
      const auto& left = tree.nodes()[static_cast<std::size_t>(node.left)];
      const auto& right = tree.nodes()[static_cast<std::size_t>(node.right)];
      EXPECT_EQ(left.first, node.first);
      EXPECT_EQ(left.last, right.first);
      EXPECT_EQ(right.last, node.last);
      EXPECT_NEAR(left.weight + right.weight, node.weight, 1e-12);
      EXPECT_EQ(node.series<0, node.radius_mm> SourceClusters::kLargestShare *
                tree.nodes()[0].radius_mm);
    }
  }
  EXPECT_EQ(points, 900);
  EXPECT_NEAR(in_leaves, 1.0, 1e-5);
}

// At a distance of several radii the series of degree 8 is the sum over the points.
TEST(SourceClusters, SeriesIsTheSumOverThePoints) {
  for (const bool planar : {true, false}) {
    const WeightedPoints p = random_points(400, planar);
    const SourceClusters tree(p.at, p.weight);
    const KernelDipole dipole{0.4, 1.5, 0.3};
    int clusters = 0;
    for (const auto& node : tree.nodes()) {
      if (node.series < 0) continue;
      EXPECT_EQ(node.planar, planar);
      ++clusters;
      RowLanes rows;
      for (std::size_t i = 0; i < kRowLanes; ++i) {
        const double turn = 0.4 * static_cast<double>(i), far = 8.0 * node.radius_mm;
        rows.x[i] = node.center_mm[0] + far * std::cos(turn);
        rows.y[i] = node.center_mm[1] + far * std::sin(turn);
        rows.z[i] = node.center_mm[2] + 0.1 * far * std::cos(3.0 * turn);
      }
      LaneSums series{}, points{};
      const KernelSeries one{tree.cluster(node), 8, node.weight};
      add_cluster_sums({&dipole, 1}, rows, {&one, 1}, {&series, 1});
      for (const auto& leaf : tree.nodes()) {
        if (leaf.left >= 0 || leaf.first < node.first || leaf.last > node.last) continue;
        tree.add_exact_sums(leaf.first, leaf.last, {&dipole, 1}, rows, {&points, 1});
      }
      for (std::size_t i = 0; i < kRowLanes; ++i) {
        EXPECT_NEAR(series.value[i], points.value[i], 3e-6 * points.value[i]);
        EXPECT_NEAR(series.decay[i], points.decay[i], 3e-6 * points.decay[i]);
        EXPECT_NEAR(series.z_d_z[i], points.z_d_z[i], 1e-5 * points.value[i]);
      }
    }
    EXPECT_GT(clusters, 10);
  }
}

TEST(SourceClusters, CoincidentAndBad) {
  const std::vector<Eigen::Vector3d> same(50, Eigen::Vector3d(1, 2, 3));
  const std::vector<double> weights(50, 2.0);
  const SourceClusters one(same, weights);
  ASSERT_EQ(one.nodes().size(), 1U);
  EXPECT_EQ(one.points(0, 0, 50).count, 50U);
  EXPECT_TRUE(SourceClusters({}, {}).empty());
  EXPECT_TRUE(SourceClusters(same, std::vector<double>(50, 0.0)).empty());
  EXPECT_THROW(SourceClusters(same, std::vector<double>(49, 1.0)), std::invalid_argument);
  EXPECT_THROW(SourceClusters(same, std::vector<double>(50, -1.0)), std::invalid_argument);
  EXPECT_THROW(SourceClusters(same, std::vector<double>(50, std::nan(""))), std::invalid_argument);
  EXPECT_THROW(SourceClusters(same, weights, 5), std::invalid_argument);
}

}  // namespace
}  // namespace scattermeter
