// Meshes of many triangles for tests.
#pragma once

#include <map>
#include <utility>

#include <Eigen/Core>

#include "core/triangle_mesh.h"

namespace scattermeter::testing {

// Every triangle cut into four, `levels` times over; with radius_mm > 0 all vertices are moved onto
// the sphere about the origin.
inline TriangleMesh subdivided(TriangleMesh mesh, int levels, double radius_mm = 0.0) {
  for (; levels > 0; --levels) {
    TriangleMesh finer;
    finer.vertices_mm = mesh.vertices_mm;
    std::map<std::pair<int, int>, int> middle_of;
    const auto middle = [&](int a, int b) {
      const auto key = std::minmax(a, b);
      const auto [it, is_new] =
          middle_of.try_emplace(key, static_cast<int>(finer.vertices_mm.size()));
      if (is_new) {
        const Eigen::Vector3d m = 0.5 * (mesh.vertices_mm[static_cast<std::size_t>(key.first)] +
                                         mesh.vertices_mm[static_cast<std::size_t>(key.second)]);
        finer.vertices_mm.push_back(m);
      }
      return it->second;
    };
    for (const auto& t : mesh.triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.triangles.push_back({t[0], a, c});
      finer.triangles.push_back({a, t[1], b});
      finer.triangles.push_back({c, b, t[2]});
      finer.triangles.push_back({a, b, c});
    }
    mesh = std::move(finer);
  }
  if (radius_mm > 0.0) {
    for (Eigen::Vector3d& v : mesh.vertices_mm) v *= radius_mm / v.norm();
  }
  return mesh;
}

// A sphere about the origin: an octahedron subdivided, 8 * 4^levels triangles.
inline TriangleMesh make_sphere(double radius_mm, int levels) {
  TriangleMesh mesh;
  mesh.vertices_mm = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  return subdivided(mesh, levels, radius_mm);
}

}  // namespace scattermeter::testing
