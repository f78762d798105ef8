#include "core/mesh/surface_normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Geometry>

#include "core/mesh/creases.h"

namespace scattermeter {
namespace {

struct Facet {
  Eigen::Vector3d normal;
  double width_mm = 0;             // the smallest altitude
  std::array<double, 3> weight{};  // of its normal at its corners
};

Facet facet_of(const TriangleMesh& mesh, std::size_t f) {
  const Eigen::Vector3d area = area_vector_mm2(mesh, static_cast<int>(f));
  Facet out{area.normalized()};
  double longest_mm = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto corner = [&](std::size_t k) {
      return mesh.vertices_mm[static_cast<std::size_t>(mesh.triangles[f][(i + k) % 3])];
    };
    const Eigen::Vector3d to_next = corner(1) - corner(0);
    const Eigen::Vector3d to_last = corner(2) - corner(0);
    longest_mm = std::max(longest_mm, to_next.norm());
    out.weight[i] = to_next.cross(to_last).norm() / (to_next.squaredNorm() * to_last.squaredNorm());
  }
  out.width_mm = 2.0 * area.norm() / longest_mm;
  return out;
}

bool are_flat(const Facet& a, const Facet& b) {
  constexpr double kOneNormal = 1e-12;
  return a.normal.dot(b.normal) > 1.0 - kOneNormal;
}

bool are_smooth(const Facet& a, const Facet& b) {
  constexpr double kPerWidth = 0.125;
  const double angle_rad = std::acos(std::clamp(a.normal.dot(b.normal), -1.0, 1.0));
  const auto [narrow_mm, wide_mm] = std::minmax(a.width_mm, b.width_mm);
  return angle_rad < kCrease_rad && wide_mm < kMostWidthRatio * narrow_mm &&
         kPerWidth * narrow_mm * angle_rad < kMostSagitta_mm;
}

// Of what is interpolated over a facet between its corners, by the place along it.
Eigen::Matrix3d slope(const TriangleMesh& mesh, std::size_t f,
                      const std::array<Eigen::Vector3d, 3>& at_corner) {
  const Eigen::Vector3d whole = 2.0 * area_vector_mm2(mesh, static_cast<int>(f));
  const auto corner_mm = [&](std::size_t i) -> const Eigen::Vector3d& {
    return mesh.vertices_mm[static_cast<std::size_t>(mesh.triangles[f][i % 3])];
  };
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d weight_per_mm =
        whole.cross(corner_mm(i + 2) - corner_mm(i + 1)) / whole.squaredNorm();
    out += at_corner[i] * weight_per_mm.transpose();
  }
  return out;
}

}  // namespace

SurfaceNormals::SurfaceNormals(const TriangleMesh& mesh) {
  const TriangleMesh welded = merge_equal_vertices(mesh);
  std::vector<Facet> facets;
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> at(welded.vertices_mm.size());
  for (std::size_t f = 0; f < welded.triangles.size(); ++f) {
    facets.push_back(facet_of(welded, f));
    of_facet_.push_back(facets.back().normal);
    for (std::size_t i = 0; i < 3; ++i) {
      at[static_cast<std::size_t>(welded.triangles[f][i])].emplace_back(f, i);
    }
  }
  curved_idx_.assign(facets.size(), -1);
  for (std::size_t f = 0; f < facets.size(); ++f) {
    std::array<Eigen::Vector3d, 3> normals;
    bool is_flat = true;
    for (std::size_t i = 0; i < 3; ++i) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const auto& [g, k] : at[static_cast<std::size_t>(welded.triangles[f][i])]) {
        if (!are_smooth(facets[f], facets[g])) continue;
        is_flat = is_flat && are_flat(facets[f], facets[g]);
        sum += facets[g].weight[k] * facets[g].normal;
      }
      normals[i] = sum.normalized();
    }
    if (is_flat) continue;
    curved_idx_[f] = static_cast<std::int32_t>(curved_.size());
    curved_.push_back({welded.vertices_mm[static_cast<std::size_t>(welded.triangles[f][0])],
                       normals[0], slope(welded, f, normals)});
  }
}

Eigen::Vector3d SurfaceNormals::at(int facet, const Eigen::Vector3d& point_mm) const {
  const Curved* c = curved(facet);
  if (c == nullptr) return of_facet(facet);
  return (c->normal_there + c->change_per_mm * (point_mm - c->corner_mm)).normalized();
}

Eigen::Matrix3d SurfaceNormals::change_per_mm(int facet) const {
  const Curved* c = curved(facet);
  return c == nullptr ? Eigen::Matrix3d::Zero() : c->change_per_mm;
}

}  // namespace scattermeter
