#include "apps/checking/edge_rows.h"

#include <algorithm>

#include "core/mesh/creases.h"

namespace scattermeter::apps {
namespace {

double distance_mm(const Eigen::Vector3d& p, const Crease& edge) {
  const Eigen::Vector3d along = edge.to_mm - edge.from_mm;
  const double t = std::clamp((p - edge.from_mm).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - edge.from_mm - t * along).norm();
}

}  // namespace

std::vector<bool> beside_edges(const TriangleMesh& mesh,
                               const std::vector<Eigen::Vector3d>& points_mm, double near_mm) {
  const std::vector<Crease> edges = creases(mesh, kCrease_rad);
  std::vector<bool> out;
  for (const Eigen::Vector3d& p : points_mm) {
    out.push_back(std::any_of(edges.begin(), edges.end(),
                              [&](const Crease& e) { return distance_mm(p, e) < near_mm; }));
  }
  return out;
}

}  // namespace scattermeter::apps
