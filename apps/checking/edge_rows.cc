#include "apps/checking/edge_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace scattermeter::apps {
namespace {

constexpr double kCrease_rad = 0.3;

struct MeshEdge {
  Eigen::Vector3d from_mm, to_mm;
};

std::vector<MeshEdge> creases(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, Eigen::Vector3d> normals;
  std::vector<MeshEdge> out;
  for (const std::array<int, 3>& facet : mesh.triangles) {
    const auto corner = [&](std::size_t i) {
      return mesh.vertices_mm[static_cast<std::size_t>(facet[i % 3])];
    };
    const Eigen::Vector3d normal =
        (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::pair<int, int> key = std::minmax(facet[i], facet[(i + 1) % 3]);
      const auto [other, is_new] = normals.try_emplace(key, normal);
      if (!is_new && other->second.dot(normal) < std::cos(kCrease_rad)) {
        out.push_back({corner(i), corner(i + 1)});
      }
    }
  }
  return out;
}

double distance_mm(const Eigen::Vector3d& p, const MeshEdge& edge) {
  const Eigen::Vector3d along = edge.to_mm - edge.from_mm;
  const double t = std::clamp((p - edge.from_mm).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (p - edge.from_mm - t * along).norm();
}

}  // namespace

std::vector<bool> beside_edges(const TriangleMesh& mesh,
                               const std::vector<Eigen::Vector3d>& points_mm, double near_mm) {
  const std::vector<MeshEdge> edges = creases(mesh);
  std::vector<bool> out;
  for (const Eigen::Vector3d& p : points_mm) {
    out.push_back(std::any_of(edges.begin(), edges.end(),
                              [&](const MeshEdge& e) { return distance_mm(p, e) < near_mm; }));
  }
  return out;
}

}  // namespace scattermeter::apps
