#include "core/transport/path_boundary.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "core/base/random_stream.h"
#include "core/material/smooth_boundary.h"
#include "tests/fixtures/core/boxes.h"
#include "tests/fixtures/core/spheres.h"

namespace scattermeter {
namespace {

using Flight = PathBoundary::Flight;

// Billiards without end: a long free flight, reflected every time. Nothing gets out, edges and
// corners of a box, of a finely cut one and of a sphere included.
void expect_tight(const TriangleMesh& mesh, PathBoundary::Method method,
                  const Eigen::Vector3d& start) {
  const RayScene scene(mesh);
  const PathBoundary boundary(scene, method);
  const Box3d box = bounds(mesh);
  for (int path = 0; path < 20; ++path) {
    RandomStream random(7, static_cast<std::uint64_t>(path));
    const RandomStream::DiscPoint p = random.disc();
    const double k = 2.0 * std::sqrt(1.0 - p.r2);
    Eigen::Vector3d direction(k * p.x, k * p.y, 1.0 - 2.0 * p.r2);
    Eigen::Vector3d x = start;
    double clearance_mm = 0.0;
    Crossing at;
    for (int i = 0; i < 2000; ++i) {
      double step_mm = 1e3;
      ASSERT_EQ(boundary.fly(x, direction, step_mm, clearance_mm, at), Flight::kAtSurface);
      ASSERT_GT(at.normal.dot(direction), 0.0);
      const int facet = boundary.facet_at(at, x);
      ASSERT_LT((boundary.facet_normal(facet) - at.normal).norm(), 1e-9);
      direction = reflected(direction, at.normal);
      ASSERT_GT((x - box.min_mm).minCoeff(), -1e-4);
      ASSERT_GT((box.max_mm - x).minCoeff(), -1e-4);
    }
  }
}

TEST(PathBoundary, IsTight) {
  using Method = PathBoundary::Method;
  const TriangleMesh cube = test_support::make_cube();
  expect_tight(cube, Method::kAuto, {1, 2, 10});
  expect_tight(cube, Method::kRays, {1, 2, 10});
  expect_tight(cut_finer(cube, 4), Method::kRays, {1, 2, 10});
  expect_tight(test_support::make_sphere(10, 4), Method::kAuto, {1, 2, 3});
  expect_tight(test_support::make_pyramid(8, 13), Method::kRays, {0.1, 0.2, 1});
}

// From places within a float's rounding of edges and corners, in all directions: as after a
// reflection there.
TEST(PathBoundary, IsTightBesideEdges) {
  for (const auto method : {PathBoundary::Method::kAuto, PathBoundary::Method::kRays}) {
    const RayScene scene(cut_finer(test_support::make_cube(), 2));
    const PathBoundary boundary(scene, method);
    RandomStream random(8, 0);
    for (int i = 0; i < 100'000; ++i) {
      const double in_mm = std::pow(10.0, -4.0 - 12.0 * random.uniform());
      Eigen::Vector3d aim(10.0, -10.0 + in_mm, 20.0 * random.uniform());
      if (i % 2 == 0) aim.z() = 20.0 - in_mm * random.uniform();
      Eigen::Vector3d x(0, 0, 10);
      double step_mm = 100.0;
      double clearance_mm = 0.0;
      Crossing at;
      ASSERT_EQ(boundary.fly(x, (aim - x).normalized(), step_mm, clearance_mm, at),
                Flight::kAtSurface);
      // A hit is as exact as the ray that Embree takes in float: 2.02e-3 with its AVX-512 kernels.
      ASSERT_LT((x - aim).norm(), 2.5e-3);
      const RandomStream::DiscPoint p = random.disc();
      const double k = 2.0 * std::sqrt(1.0 - p.r2);
      Eigen::Vector3d direction(k * p.x, k * p.y, 1.0 - 2.0 * p.r2);
      if (direction.dot(at.normal) > 0.0) direction = reflected(direction, at.normal);
      step_mm = 100.0;
      const Eigen::Vector3d from = x;
      ASSERT_EQ(boundary.fly(x, direction, step_mm, clearance_mm, at), Flight::kAtSurface) << i;
      double expected_mm = 1e9;
      for (int axis = 0; axis < 3; ++axis) {
        const double wall =
            axis == 2 ? (direction.z() > 0 ? 20.0 : 0.0) : std::copysign(10.0, direction[axis]);
        expected_mm = std::min(expected_mm, (wall - from[axis]) / direction[axis]);
      }
      ASSERT_NEAR(at.distance_mm, std::max(0.0, expected_mm), 1e-3);
    }
  }
}

// Steps inside, and what they leave of the clearance.
TEST(PathBoundary, KeepsABoundOfTheDistance) {
  for (const auto method : {PathBoundary::Method::kAuto, PathBoundary::Method::kRays}) {
    const RayScene scene(test_support::make_cube());
    const PathBoundary boundary(scene, method);
    RandomStream random(9, 0);
    Eigen::Vector3d x(0, 0, 10);
    double clearance_mm = 0.0;
    Crossing at;
    for (int i = 0; i < 20'000; ++i) {
      const RandomStream::DiscPoint p = random.disc();
      const double k = 2.0 * std::sqrt(1.0 - p.r2);
      const Eigen::Vector3d direction(k * p.x, k * p.y, 1.0 - 2.0 * p.r2);
      double step_mm = random.uniform();
      if (boundary.fly(x, direction, step_mm, clearance_mm, at) == Flight::kAtSurface) {
        x = {0, 0, 10};
        clearance_mm = 0.0;
      }
      const double distance_mm =
          std::min({10.0 - std::abs(x.x()), 10.0 - std::abs(x.y()), x.z(), 20.0 - x.z()});
      ASSERT_LE(clearance_mm, distance_mm + 1e-9);
    }
  }
}

// A box with a pit down to a point: not convex.
TriangleMesh make_bowl() {
  TriangleMesh bowl = test_support::make_cube();
  bowl.vertices_mm.emplace_back(0, 0, 12);
  bowl.triangles.erase(bowl.triangles.begin() + 2, bowl.triangles.begin() + 4);
  for (const auto& [a, b] : {std::pair{4, 5}, {5, 7}, {7, 6}, {6, 4}}) {
    bowl.triangles.push_back({a, b, 8});
  }
  return bowl;
}

// Height of a point above the walls of the pit.
double above_bowl_mm(const Eigen::Vector3d& x) {
  return x.z() - 12.0 - 0.8 * std::max(std::abs(x.x()), std::abs(x.y()));
}

// What leaves through one wall of the pit comes in by the other.
TEST(PathBoundary, FindsWhereLightEntersAgain) {
  const TriangleMesh bowl = make_bowl();
  const RayScene scene(bowl);
  const PathBoundary boundary(scene);
  ASSERT_FALSE(boundary.by_planes());
  // On the -x wall of the pit, z = 12 + 0.8 |x|.
  const Eigen::Vector3d x(-5, 0, 16);
  const auto at = boundary.entering(x, {1, 0, 0});
  ASSERT_TRUE(at.has_value());
  EXPECT_NEAR(at->distance_mm, 10.0, 1e-4);
  EXPECT_LT(at->normal.x(), 0.0);
  EXPECT_FALSE(boundary.entering(x, {0, 0, 1}).has_value());
  EXPECT_FALSE(boundary.clear_inside({-9, 0, 19}, {9, 0, 19}));
  EXPECT_TRUE(boundary.clear_inside({-9, 0, 10}, {9, 0, 10}));
}

// Lines between points of a body that is not convex, with rays where a plane lies between them and
// without: as sampled along them. A line that leaves the body by less than 0.02 mm may be either.
TEST(PathBoundary, LinesInABodyThatIsNotConvex) {
  const TriangleMesh bowl = make_bowl();
  const RayScene scene(bowl);
  const PathBoundary boundary(scene);
  RandomStream random(10, 0);
  int clear = 0, blocked = 0;
  while (clear < 3000 || blocked < 300) {
    const auto inside = [&]() -> Eigen::Vector3d {
      for (;;) {
        const Eigen::Vector3d x(20.0 * random.uniform() - 10.0, 20.0 * random.uniform() - 10.0,
                                20.0 * random.uniform());
        if (above_bowl_mm(x) < 0.0) return x;
      }
    };
    const Eigen::Vector3d from = inside(), to = inside();
    double most_mm = -1e9;
    for (double t = 0.0; t <= 1.0; t += 1e-3) {
      most_mm = std::max(most_mm, above_bowl_mm(from + t * (to - from)));
    }
    if (std::abs(most_mm) < 0.02) continue;
    ASSERT_EQ(boundary.clear_inside(from, to), most_mm < 0.0) << from << "\n" << to;
    (most_mm < 0.0 ? clear : blocked)++;
  }
}

TEST(PathBoundary, FacetsOfAPlane) {
  const TriangleMesh bowl = make_bowl();
  const RayScene scene(bowl);
  const PathBoundary boundary(scene);
  // The pit's wall at x < 0, and the plane that it lies on.
  const int wall = boundary.facet_seen({0, 0, 100}, {-5, 1, 16}, [&] {
    for (std::size_t k = 0; k < boundary.body().planes.size(); ++k) {
      const BodyPlane& p = boundary.body().planes[k];
      if (p.normal.x() > 0.1 && p.normal.x() < 0.9) return static_cast<int>(k);
    }
    return -1;
  }());
  ASSERT_GE(wall, 0);
  const int plane = boundary.body().plane_of_facet[static_cast<std::size_t>(wall)];
  EXPECT_EQ(boundary.facet_holding(plane, {-5, 1, 16}), wall);
  EXPECT_EQ(boundary.facet_holding(plane, {-5, 6, 16}), -1);  // beyond its edge
  EXPECT_EQ(boundary.facet_of_plane(plane, {-5, 6, 16}), wall);
  EXPECT_TRUE(boundary.reaches_plane({-9, 1, 5}, {-5, 1, 16}, plane));
  EXPECT_FALSE(boundary.reaches_plane({-9, 1, 5}, {-5, 6, 16}, plane));
  // Through the pit.
  EXPECT_FALSE(boundary.reaches_plane({9.5, 1, 19}, {-5, 1, 16}, plane));
}

}  // namespace
}  // namespace scattermeter
