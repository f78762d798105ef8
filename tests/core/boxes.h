// Simple closed meshes for tests.
#pragma once

#include <Eigen/Core>

#include "core/triangle_mesh.h"

namespace scattermeter::test_support {

// Axis-aligned box, 12 triangles, outward normals.
inline TriangleMesh make_box(const Eigen::Vector3d& min_mm, const Eigen::Vector3d& max_mm) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices_mm.emplace_back((i & 1) != 0 ? max_mm.x() : min_mm.x(),
                                  (i & 2) != 0 ? max_mm.y() : min_mm.y(),
                                  (i & 4) != 0 ? max_mm.z() : min_mm.z());
  }
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// The 20 mm cube on z = 0.
inline TriangleMesh make_cube() { return make_box({-10, -10, 0}, {10, 10, 20}); }

// Square pyramid (base 2 * half_mm, height_mm) with its base on z = 0.
inline TriangleMesh make_pyramid(double half_mm, double height_mm) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{-half_mm, -half_mm, 0},
                      {half_mm, -half_mm, 0},
                      {half_mm, half_mm, 0},
                      {-half_mm, half_mm, 0},
                      {0, 0, height_mm}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  return mesh;
}

}  // namespace scattermeter::test_support
