// Bodies of many facets that are not convex.
#pragma once

#include <cmath>
#include <utility>

#include "tests/core/spheres.h"

namespace scattermeter::test_support {

// A sphere with waves of a depth on it: radius (1 + depth sin 5x sin 5y sin 5z) for a point
// (x, y, z) of the unit sphere.
inline TriangleMesh make_bumps(double radius_mm, double depth, int levels) {
  TriangleMesh mesh = make_sphere(1.0, levels);
  for (Eigen::Vector3d& v : mesh.vertices_mm) {
    v *= radius_mm *
         (1.0 + depth * std::sin(5.0 * v.x()) * std::sin(5.0 * v.y()) * std::sin(5.0 * v.z()));
  }
  return mesh;
}

}  // namespace scattermeter::test_support
