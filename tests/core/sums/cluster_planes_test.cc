#include "core/sums/cluster_planes.h"

#include <random>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

// A plane by its axes, 100 mm off.
struct TiltedPlane {
  Eigen::Vector3d at{100, -40, 7};
  Eigen::Matrix3d axes =
      Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  Eigen::Vector3d normal() const { return axes.row(2); }

  std::vector<WeightedPoint> points(int count) const {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-10.0, 10.0);
    std::vector<WeightedPoint> out;
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector3d p =
          at + axes.transpose() * Eigen::Vector3d(uniform(random), uniform(random), 0.0);
      out.push_back({{p.x(), p.y(), p.z(), 1.0}});
    }
    return out;
  }
};

void expect_frame_of(const Eigen::Matrix3d& frame, const Eigen::Vector3d& normal) {
  EXPECT_LT((frame * frame.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  EXPECT_NEAR(std::abs(frame.row(2).dot(normal)), 1.0, 1e-12);
}

TEST(ClusterPlanes, OfAllHoldsEveryPoint) {
  const TiltedPlane plane;
  std::vector<WeightedPoint> points = plane.points(200);
  const auto frame = plane_of_all(points, plane.at, 15.0);
  ASSERT_TRUE(frame.has_value());
  expect_frame_of(*frame, plane.normal());
  points[77].placed.head<3>() += 2e-7 * 15.0 * plane.normal().array();
  EXPECT_FALSE(plane_of_all(points, plane.at, 15.0).has_value());
}

TEST(ClusterPlanes, PointsOnALineOrAtOnePlaceHaveNone) {
  std::vector<WeightedPoint> line;
  for (int i = 0; i < 50; ++i) line.push_back({{1.0 * i, 2.0 * i, 3.0, 1.0}});
  const Eigen::Vector3d middle(25, 50, 3);
  EXPECT_FALSE(plane_of_all(line, middle, 60.0).has_value());
  EXPECT_FALSE(plane_of_many(line, 100.0).has_value());
  const std::vector<WeightedPoint> one(1, {{1, 2, 3, 1}});
  EXPECT_FALSE(plane_of_all(one, {1, 2, 3}, 0.0).has_value());
  EXPECT_FALSE(plane_of_many(one, 0.0).has_value());
}

TEST(ClusterPlanes, OfManyHoldsTheirPointsAlone) {
  const TiltedPlane plane;
  std::vector<WeightedPoint> points = plane.points(300);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0.5, 10.0);
  for (std::size_t i = 0; i < points.size(); i += 2) {
    points[i].placed.head<3>() += uniform(random) * plane.normal().array();
  }
  const auto found = plane_of_many(points, 20.0);
  ASSERT_TRUE(found.has_value());
  expect_frame_of(found->frame, plane.normal());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(found->holds(points[i].at()), i % 2 == 1) << i;
  }
}

TEST(ClusterPlanes, PointsInSpaceHaveNone) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<WeightedPoint> points;
  for (int i = 0; i < 500; ++i)
    points.push_back({{normal(random), normal(random), normal(random), 1}});
  EXPECT_FALSE(plane_of_many(points, 6.0).has_value());
  EXPECT_FALSE(plane_of_all(points, Eigen::Vector3d::Zero(), 4.0).has_value());
}

}  // namespace
}  // namespace scattermeter
