#include "core/mesh/creases.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace scattermeter {

std::vector<Crease> creases(const TriangleMesh& mesh, double least_rad) {
  const TriangleMesh welded = merge_equal_vertices(mesh);
  const double least_cos = std::cos(least_rad);
  std::map<std::pair<int, int>, Eigen::Vector3d> normals;  // by the vertices of an edge
  std::vector<Crease> out;
  for (std::size_t f = 0; f < welded.triangles.size(); ++f) {
    const auto& facet = welded.triangles[f];
    const auto corner = [&](std::size_t i) {
      return welded.vertices_mm[static_cast<std::size_t>(facet[i % 3])];
    };
    const Eigen::Vector3d normal = area_vector_mm2(welded, static_cast<int>(f)).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::pair<int, int> key = std::minmax(facet[i], facet[(i + 1) % 3]);
      const auto [other, is_new] = normals.try_emplace(key, normal);
      if (!is_new && other->second.dot(normal) < least_cos) {
        out.push_back({corner(i), corner(i + 1), {other->second, normal}});
      }
    }
  }
  return out;
}

bool is_round(const TriangleMesh& mesh) {
  constexpr double kSharp_rad = 0.6435;
  return creases(mesh, kSharp_rad).empty();
}

}  // namespace scattermeter
