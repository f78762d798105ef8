#include "core/mesh/round_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/mesh/bodies.h"

namespace scattermeter {
namespace {

std::array<Eigen::Vector3d, 3> corners(const TriangleMesh& mesh, std::size_t triangle) {
  std::array<Eigen::Vector3d, 3> out;
  for (std::size_t k = 0; k < 3; ++k) {
    out[k] = mesh.vertices_mm[static_cast<std::size_t>(mesh.triangles[triangle][k])];
  }
  return out;
}

// Of each edge, the two triangles.
std::map<std::pair<int, int>, std::vector<std::size_t>> edges(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, std::vector<std::size_t>> out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      out[std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3])].push_back(t);
    }
  }
  return out;
}

// Edges at which the surface is hollow: the far corner of one triangle lies in front of the other.
double hollow_share(const TriangleMesh& mesh) {
  double hollow = 0.0, all = 0.0;
  for (const auto& [edge, triangles] : edges(mesh)) {
    const Eigen::Vector3d normal =
        area_vector_mm2(mesh, static_cast<int>(triangles[0])).normalized();
    const Eigen::Vector3d on = mesh.vertices_mm[static_cast<std::size_t>(edge.first)];
    for (const Eigen::Vector3d& corner : corners(mesh, triangles[1])) {
      if (normal.dot(corner - on) > 1e-9) {
        hollow += 1.0;
        break;
      }
    }
    all += 1.0;
  }
  return hollow / all;
}

TEST(Bodies, AreClosedAndStandAtTheOrigin) {
  for (const std::string& name : body_names()) {
    const TriangleMesh mesh = body_mesh(name);
    EXPECT_EQ(mesh_problem(mesh), "") << name;
    const Box3d box = bounds(mesh);
    EXPECT_NEAR(box.min_mm.z(), 0.0, 1e-12) << name;
    EXPECT_NEAR(box.center_mm().x(), 0.0, 1e-12) << name;
    EXPECT_NEAR(box.center_mm().y(), 0.0, 1e-12) << name;
    // Euler: a closed surface without handles, in one piece, no corner used twice.
    const auto v = static_cast<int>(mesh.vertices_mm.size());
    const auto f = static_cast<int>(mesh.triangles.size());
    EXPECT_EQ(v - static_cast<int>(edges(mesh).size()) + f, 2) << name;
    for (const auto& [edge, triangles] : edges(mesh)) EXPECT_EQ(triangles.size(), 2U) << name;
  }
  EXPECT_NEAR(signed_volume_mm3(slab_mesh()), 40.0 * 40.0 * 10.0, 1e-9);
  EXPECT_THROW(body_mesh("torus"), std::invalid_argument);
}

TEST(RoundBodies, SphereOfTenMm) {
  const TriangleMesh mesh = sphere_mesh();
  ASSERT_EQ(mesh.triangles.size(), 5120U);
  const Eigen::Vector3d center(0, 0, 10);
  for (const Eigen::Vector3d& v : mesh.vertices_mm) ASSERT_NEAR((v - center).norm(), 10.0, 1e-12);
  // A facet of edge a lies a^2 / 8 R below the sphere in the mean (a^2 / 3 less a^2 / 12 over 2 R),
  // so that 3 a^2 / 8 R^2 of the volume is missing: 0.21 %, with a of the mean facet, area
  // 4 pi R^2 / 5120. Facets differ by some 10 % in edge, and their squares count.
  const double a2 = 4.0 * std::numbers::pi / 5120.0 * 4.0 / std::sqrt(3.0);
  const double missing = 1.0 - signed_volume_mm3(mesh) / (4000.0 / 3.0 * std::numbers::pi);
  EXPECT_NEAR(missing, 3.0 / 8.0 * a2, 0.1 * a2);
  EXPECT_EQ(hollow_share(mesh), 0.0);
}

TEST(RoundBodies, CylinderOfTenMm) {
  constexpr int kSides = 96;
  const TriangleMesh mesh = cylinder_mesh(kSides);
  EXPECT_EQ(mesh_problem(mesh), "");
  // Eight bands; circles of 42, 36, ... 6 corners and the centre in each cap.
  EXPECT_EQ(mesh.triangles.size(),
            8U * 2U * kSides + 2U * (kSides + 2U * (42 + 36 + 30 + 24 + 18 + 12 + 6)));
  EXPECT_EQ(bounds(mesh).min_mm.z(), 0.0);
  EXPECT_EQ(bounds(mesh).max_mm.z(), 20.0);
  // Of the polygon of its sides.
  const double area_mm2 = 0.5 * kSides * 100.0 * std::sin(2.0 * std::numbers::pi / kSides);
  EXPECT_NEAR(signed_volume_mm3(mesh), 20.0 * area_mm2, 1e-6);
}

TEST(RoundBodies, ScanIsIrregularAndConcaveInPlaces) {
  const TriangleMesh mesh = scanned_mesh();
  ASSERT_EQ(mesh.triangles.size(), 20480U);
  EXPECT_NEAR(bounds(mesh).size_mm().maxCoeff(), 20.0, 1e-9);
  EXPECT_GT(bounds(mesh).size_mm().minCoeff(), 12.0);
  EXPECT_GT(hollow_share(mesh), 0.05);
  EXPECT_LT(hollow_share(mesh), 0.5);
  // No sliver, and no two alike: heights over longest edges.
  std::set<double> shapes;
  double worst = 1.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = corners(mesh, t);
    const double longest = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()});
    const double area = area_vector_mm2(mesh, static_cast<int>(t)).norm();
    shapes.insert(2.0 * area / (longest * longest));
    worst = std::min(worst, 2.0 * area / (longest * longest));
  }
  EXPECT_EQ(shapes.size(), mesh.triangles.size());
  EXPECT_GT(worst, 0.15);  // 0.87 if equilateral
  // The same every time.
  const TriangleMesh again = scanned_mesh();
  EXPECT_TRUE(
      std::equal(mesh.vertices_mm.begin(), mesh.vertices_mm.end(), again.vertices_mm.begin()));
  // All of the surface is seen from a point inside: it does not pass through itself.
  bool seen = false;
  const Box3d box = bounds(mesh);
  for (double x = -3.0; x <= 3.0 && !seen; x += 0.5) {
    for (double y = -3.0; y <= 3.0 && !seen; y += 0.5) {
      for (double z = -3.0; z <= 3.0 && !seen; z += 0.5) {
        const Eigen::Vector3d middle = box.center_mm() + Eigen::Vector3d(x, y, z);
        seen = true;
        for (std::size_t t = 0; t < mesh.triangles.size() && seen; ++t) {
          seen = area_vector_mm2(mesh, static_cast<int>(t)).dot(corners(mesh, t)[0] - middle) > 0;
        }
      }
    }
  }
  EXPECT_TRUE(seen);
}

}  // namespace
}  // namespace scattermeter
