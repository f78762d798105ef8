#include "core/sums/cluster_tree.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

namespace scattermeter {
namespace {

// Enough for parts that grow at the same time: a cube's faces, and points within it.
std::vector<WeightedPoint> cube_and_inside(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-10.0, 10.0);
  std::vector<WeightedPoint> points;
  for (int i = 0; i < count; ++i) {
    Eigen::Array4d p(uniform(random), uniform(random), uniform(random), 1.0 + i % 3);
    if (i % 8 < 6) p[i % 8 / 2] = i % 2 == 0 ? 10.0 : -10.0;
    points.push_back({p});
  }
  return points;
}

TEST(ClusterTree, PartsAreTheWhole) {
  std::vector<WeightedPoint> points = cube_and_inside(30000);
  const ClusterTree tree(points);
  const ClusterNode& root = tree.nodes.front();
  EXPECT_EQ(root.first, 0);
  EXPECT_EQ(root.last, 30000);
  EXPECT_NEAR(root.weight, 60000.0, 1e-6);
  std::int32_t in_leaves = 0;
  for (std::size_t at = 0; at < tree.nodes.size(); ++at) {
    const ClusterNode& node = tree.nodes[at];
    EXPECT_EQ(node.series, -1);
    ASSERT_EQ(node.left < 0, node.right < 0);
    const Eigen::Map<const Eigen::Vector3d> center(node.center_mm);
    if (node.left < 0) {
      const ClusterNode& bucket = tree.nodes[static_cast<std::size_t>(node.bucket)];
      EXPECT_LE(bucket.first, node.first);
      EXPECT_GE(bucket.last, node.last);
      EXPECT_LE(bucket.last - bucket.first, ClusterTree::kBucket);
      EXPECT_LE(node.last - node.first, ClusterTree::kLeaf);
      in_leaves += node.last - node.first;
    } else {
      const ClusterNode& left = tree.nodes[static_cast<std::size_t>(node.left)];
      const ClusterNode& right = tree.nodes[static_cast<std::size_t>(node.right)];
      ASSERT_GT(node.left, static_cast<std::int32_t>(at));
      ASSERT_GT(node.right, node.left);
      EXPECT_EQ(left.first, node.first);
      EXPECT_EQ(left.last, right.first);
      EXPECT_EQ(right.last, node.last);
      EXPECT_NEAR(left.weight + right.weight, node.weight, 1e-9 * node.weight);
      const Eigen::Map<const Eigen::Vector3d> a(left.center_mm), b(right.center_mm);
      EXPECT_LT(((left.weight * a + right.weight * b) / node.weight - center).norm(), 1e-9);
    }
    double farthest = 0.0;
    for (std::int32_t i = node.first; i < node.last; ++i) {
      const Eigen::Vector3d p = points[static_cast<std::size_t>(i)].at();
      farthest = std::max(farthest, (p - center).norm());
      if (node.plane >= 0) {
        ASSERT_TRUE(tree.planes[static_cast<std::size_t>(node.plane)].holds(p));
      }
    }
    EXPECT_GE(node.radius_mm, farthest);
    EXPECT_LE(node.radius_mm, farthest * (1.0 + 1e-9));
  }
  EXPECT_EQ(in_leaves, 30000);
}

// Points of a face are told from those within: few leaves of a cube's shell hold more than a plane.
TEST(ClusterTree, FacesAreTold) {
  std::vector<WeightedPoint> points = cube_and_inside(30000);
  const ClusterTree tree(points);
  std::int32_t in_planes = 0;
  for (const ClusterNode& node : tree.nodes) {
    if (node.left < 0 && node.plane >= 0) in_planes += node.last - node.first;
  }
  EXPECT_GT(in_planes, 0.95 * 22500);
  EXPECT_LE(in_planes, 22500);
}

TEST(ClusterTree, IsTheSameForAnyNumberOfThreads) {
  std::vector<WeightedPoint> points = cube_and_inside(20000), again = points;
  const ClusterTree tree(points);
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const ClusterTree alone(again);
  ASSERT_EQ(tree.nodes.size(), alone.nodes.size());
  ASSERT_EQ(tree.planes.size(), alone.planes.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE((points[i].placed == again[i].placed).all());
  }
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    const ClusterNode &a = tree.nodes[i], &b = alone.nodes[i];
    ASSERT_EQ(a.radius_mm, b.radius_mm);
    ASSERT_EQ(a.weight, b.weight);
    ASSERT_EQ(std::tie(a.first, a.last, a.left, a.right, a.bucket, a.plane),
              std::tie(b.first, b.last, b.left, b.right, b.bucket, b.plane));
  }
}

TEST(ClusterTree, PointsThatCoincideAreOneLeaf) {
  std::vector<WeightedPoint> points(50, {{1, 2, 3, 0.5}});
  const ClusterTree tree(points);
  ASSERT_EQ(tree.nodes.size(), 1U);
  EXPECT_EQ(tree.nodes[0].radius_mm, 0.0);
  EXPECT_EQ(tree.nodes[0].last, 50);
}

}  // namespace
}  // namespace scattermeter
