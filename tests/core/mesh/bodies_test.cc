#include "core/mesh/bodies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace scattermeter {
namespace {

const Eigen::Vector3d& corner(const TriangleMesh& mesh, std::size_t t, std::size_t i) {
  return mesh.vertices_mm[static_cast<std::size_t>(mesh.triangles[t][i])];
}

// By the divergence theorem: positive only where normals point outwards.
double volume_mm3(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    sum += corner(mesh, t, 0).dot(corner(mesh, t, 1).cross(corner(mesh, t, 2))) / 6.0;
  }
  return sum;
}

double surface_mm2(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Eigen::Vector3d a = corner(mesh, t, 1) - corner(mesh, t, 0);
    sum += 0.5 * a.cross(corner(mesh, t, 2) - corner(mesh, t, 0)).norm();
  }
  return sum;
}

TEST(Bodies, HaveTheVolumesOfTheirFormulas) {
  EXPECT_NEAR(volume_mm3(cube_mesh()), 8000.0, 1e-9);
  EXPECT_NEAR(volume_mm3(slab_mesh()), 16000.0, 1e-9);
  EXPECT_NEAR(volume_mm3(pyramid_mesh()), 20.0 * 20.0 * 20.0 / 3.0, 1e-9);
  EXPECT_NEAR(volume_mm3(pyramid_on_pedestal_mesh()), 22.0 * 22.0 * 7.0 + 16.0 * 16.0 * 13.0 / 3.0,
              1e-9);
}

TEST(Bodies, HaveTheSurfacesOfTheirFormulas) {
  EXPECT_NEAR(surface_mm2(cube_mesh()), 6.0 * 400.0, 1e-9);
  EXPECT_NEAR(surface_mm2(slab_mesh()), 2.0 * 1600.0 + 4.0 * 400.0, 1e-9);
  // Four sides with a slant height of sqrt(20^2 + 10^2), and the base.
  EXPECT_NEAR(surface_mm2(pyramid_mesh()), 400.0 + 4.0 * 0.5 * 20.0 * std::sqrt(500.0), 1e-9);
  EXPECT_NEAR(surface_mm2(pyramid_on_pedestal_mesh()),
              22.0 * 22.0 + 4.0 * 22.0 * 7.0 + (22.0 * 22.0 - 16.0 * 16.0) +
                  4.0 * 0.5 * 16.0 * std::hypot(13.0, 8.0),
              1e-9);
}

// Every edge is shared by two triangles that run along it in opposite directions.
TEST(Bodies, AreClosedAndStandOnTheGround) {
  for (const std::string& name : body_names()) {
    const TriangleMesh mesh = body_mesh(name);
    std::map<std::pair<int, int>, int> edges;
    for (const auto& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
    }
    for (const auto& [edge, n] : edges) {
      EXPECT_EQ(n, 1) << name;
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U) << name;
    }
    double lowest = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& v : mesh.vertices_mm) lowest = std::min(lowest, v.z());
    EXPECT_NEAR(lowest, 0.0, 1e-9) << name;
    EXPECT_GT(volume_mm3(mesh), 0.0) << name;
  }
}

// Seen from the centre of a convex body every facet faces away.
TEST(Bodies, NormalsPointOutwards) {
  for (const TriangleMesh& mesh : {cube_mesh(), slab_mesh(), pyramid_mesh()}) {
    const Eigen::Vector3d inside(0, 0, 5);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const Eigen::Vector3d normal =
          (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0));
      EXPECT_GT(normal.dot(corner(mesh, t, 0) - inside), 0.0);
    }
  }
}

TEST(Bodies, UnknownNameIsRefused) { EXPECT_THROW(body_mesh("teapot"), std::invalid_argument); }

}  // namespace
}  // namespace scattermeter
