#include "core/convexity.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

constexpr double kFlat = 1e-9;

// An edge with the facet that it belongs to and the facet's third corner.
struct Side {
  std::pair<int, int> edge;
  int facet;
  int apex;
};

}  // namespace

bool is_convex(const TriangleMesh& repeated) {
  const TriangleMesh mesh = merge_equal_vertices(repeated);
  const double rise_mm = kFlat * bounds(mesh).size_mm().maxCoeff();
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      sides.push_back({std::minmax(t[i], t[(i + 1) % 3]), static_cast<int>(f), t[(i + 2) % 3]});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.edge < b.edge; });
  std::vector<int> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int f) {
    while (parent[static_cast<std::size_t>(f)] != f) {
      f = parent[static_cast<std::size_t>(f)] =
          parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(f)])];
    }
    return f;
  };
  std::size_t pieces = mesh.triangles.size();
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const Side& a = sides[i];
    const Side& b = sides[i + 1];
    const Eigen::Vector3d normal = area_vector_mm2(mesh, a.facet).normalized();
    const Eigen::Vector3d up = mesh.vertices_mm[static_cast<std::size_t>(b.apex)] -
                               mesh.vertices_mm[static_cast<std::size_t>(a.edge.first)];
    if (normal.dot(up) > rise_mm) return false;
    const int ra = root(a.facet);
    const int rb = root(b.facet);
    if (ra == rb) continue;
    parent[static_cast<std::size_t>(ra)] = rb;
    --pieces;
  }
  return pieces == 1;
}

}  // namespace scattermeter
