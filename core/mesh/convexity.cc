#include "core/mesh/convexity.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "core/base/disjoint_sets.h"

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

bool is_convex(const TriangleMesh& mesh) {
  const TriangleMesh welded = merge_equal_vertices(mesh);
  const double rise_mm = kFlat * bounds(welded).size_mm().maxCoeff();
  std::vector<Side> sides;
  sides.reserve(3 * welded.triangles.size());
  for (std::size_t f = 0; f < welded.triangles.size(); ++f) {
    const auto& t = welded.triangles[f];
    for (std::size_t i = 0; i < 3; ++i) {
      sides.push_back({std::minmax(t[i], t[(i + 1) % 3]), static_cast<int>(f), t[(i + 2) % 3]});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return a.edge < b.edge; });
  DisjointSets pieces(welded.triangles.size());
  for (std::size_t i = 0; i + 1 < sides.size(); i += 2) {
    const Side& a = sides[i];
    const Side& b = sides[i + 1];
    const Eigen::Vector3d normal = area_vector_mm2(welded, a.facet).normalized();
    const Eigen::Vector3d up = welded.vertices_mm[static_cast<std::size_t>(b.apex)] -
                               welded.vertices_mm[static_cast<std::size_t>(a.edge.first)];
    if (normal.dot(up) > rise_mm) return false;
    pieces.join(a.facet, b.facet);
  }
  return pieces.sets() == 1;
}

}  // namespace scattermeter
