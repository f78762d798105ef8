// Meshes of many triangles for tests.
#pragma once

#include <utility>

#include <Eigen/Core>

#include "core/triangle_mesh.h"

namespace scattermeter::test_support {

// A sphere about the origin: an octahedron cut finer, its vertices moved onto the sphere;
// 8 * 4^levels triangles.
inline TriangleMesh make_sphere(double radius_mm, int levels) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  mesh = cut_finer(std::move(mesh), levels);
  for (Eigen::Vector3d& v : mesh.vertices_mm) v *= radius_mm / v.norm();
  return mesh;
}

}  // namespace scattermeter::test_support
