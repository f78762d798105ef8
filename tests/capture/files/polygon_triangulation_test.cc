#include "capture/files/polygon_triangulation.h"

#include <cmath>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace scattermeter::capture {
namespace {

using Eigen::Vector3d;
using Polygon = std::vector<Vector3d>;

Vector3d area_of(const Polygon& p) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += 0.5 * p[i].cross(p[(i + 1) % p.size()]);
  return sum;
}

// A triangulation that tiles the polygon: n - 2 triangles, each turning as the polygon does and
// none without area, and their areas add up to the polygon's. (An outside diagonal would add a
// triangle that turns the other way, or too much area.)
void expect_tiling(const Polygon& polygon) {
  const auto triangles = triangulate_polygon(polygon);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const Vector3d whole = area_of(polygon);
  double sum = 0;
  for (const auto& t : triangles) {
    const Vector3d area =
        area_of({polygon[static_cast<std::size_t>(t[0])], polygon[static_cast<std::size_t>(t[1])],
                 polygon[static_cast<std::size_t>(t[2])]});
    EXPECT_GT(area.dot(whole), 0) << t[0] << " " << t[1] << " " << t[2];
    sum += area.norm();
  }
  EXPECT_NEAR(sum / whole.norm(), 1, 1e-12);
}

Polygon flat(const std::vector<std::array<double, 2>>& corners) {
  Polygon polygon;
  for (const auto& [x, y] : corners) polygon.emplace_back(x, y, 0);
  return polygon;
}

TEST(TriangulatePolygon, Triangle) {
  EXPECT_THAT(triangulate_polygon(flat({{0, 0}, {1, 0}, {0, 1}})),
              testing::ElementsAre(std::array<int, 3>{0, 1, 2}));
  EXPECT_TRUE(triangulate_polygon(flat({{0, 0}, {1, 0}})).empty());
}

TEST(TriangulatePolygon, PolygonsOfManyShapesFromEveryCorner) {
  const std::vector<Polygon> shapes = {
      flat({{0, 0}, {1, 0}, {1, 1}, {0, 1}}),                          // square
      flat({{0, 0}, {4, 1}, {0, 2}, {1, 1}}),                          // arrow head
      flat({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}),          // L
      flat({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}),  // corners on straight edges
      flat({{0, 0}, {3, 0}, {3, 3}, {1, 3}, {1, 2}, {2, 2}, {2, 1}, {1, 1}, {0, 3}}),
      flat({{0, 0},
            {5, 0},
            {5, 4},
            {4, 4},
            {4, 1},
            {3, 1},
            {3, 4},
            {2, 4},
            {2, 1},
            {1, 1},
            {1, 4},
            {0, 4}})};  // comb
  const Eigen::Matrix3d tilt =
      Eigen::AngleAxisd(1.1, Vector3d(1, 2, -0.5).normalized()).toRotationMatrix();
  for (const Polygon& shape : shapes) {
    for (std::size_t first = 0; first < shape.size(); ++first) {
      Polygon turned;
      for (std::size_t i = 0; i < shape.size(); ++i) {
        turned.emplace_back(tilt * (shape[(first + i) % shape.size()] + Vector3d(30, -20, 10)));
      }
      expect_tiling(turned);
      expect_tiling({turned.rbegin(), turned.rend()});
    }
  }
}

TEST(TriangulatePolygon, RandomStarsOf300Corners) {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> radius(1.0, 10.0);
  for (int repeat = 0; repeat < 20; ++repeat) {
    Polygon star;
    for (int i = 0; i < 300; ++i) {
      const double angle = 2 * std::numbers::pi * i / 300;
      const double r = radius(generator);
      star.emplace_back(r * std::cos(angle), r * std::sin(angle), 5.0);
    }
    expect_tiling(star);
  }
}

TEST(TriangulatePolygon, WithoutAreaOrCrossingItselfStillCounts) {
  EXPECT_EQ(triangulate_polygon(flat({{0, 0}, {1, 0}, {2, 0}, {3, 0}})).size(), 2U);
  EXPECT_EQ(triangulate_polygon(flat({{0, 0}, {0, 0}, {0, 0}, {0, 0}})).size(), 2U);
  EXPECT_EQ(triangulate_polygon(flat({{0, 0}, {1, 1}, {1, 0}, {0, 1}})).size(), 2U);
}

}  // namespace
}  // namespace scattermeter::capture
