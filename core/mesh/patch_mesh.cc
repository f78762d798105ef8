#include "core/mesh/patch_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>

#include <Eigen/Geometry>

namespace scattermeter {

PatchMesh::PatchMesh(const TriangleMesh& mesh, double size_mm, std::size_t max_patches)
    : size_mm_(size_mm), vertices_mm_(mesh.vertices_mm), normals_(mesh) {
  if (!(size_mm > 0.0)) {
    throw std::invalid_argument("PatchMesh: size_mm = " + std::to_string(size_mm));
  }
  const double max_area_mm2 = size_mm * size_mm;
  const double max_edge_mm = 2.5 * size_mm;
  const int n_facets = static_cast<int>(mesh.triangles.size());

  struct Open {
    std::int32_t node;
    int facet;
    std::array<int, 3> vertex;
  };
  std::vector<Open> open;
  nodes_.assign(mesh.triangles.size(), {0, 0});
  std::map<std::pair<int, int>, int> middle_of;
  const auto middle = [&](int a, int b) {
    const auto key = std::minmax(a, b);
    const auto [it, is_new] = middle_of.try_emplace(key, static_cast<int>(vertices_mm_.size()));
    if (is_new) vertices_mm_.push_back(0.5 * (vertices_mm_[key.first] + vertices_mm_[key.second]));
    return it->second;
  };
  // Facet by facet, depth first: the patches of a facet are contiguous, neighbours near each other.
  for (int f = 0; f < n_facets; ++f) {
    open.push_back({f, f, mesh.triangles[static_cast<std::size_t>(f)]});
    while (!open.empty()) {
      const Open t = open.back();
      open.pop_back();
      const std::array<Eigen::Vector3d, 3> p = {
          vertices_mm_[t.vertex[0]], vertices_mm_[t.vertex[1]], vertices_mm_[t.vertex[2]]};
      // edge[i] lies opposite corner i.
      const std::array<double, 3> edge = {(p[2] - p[1]).norm(), (p[0] - p[2]).norm(),
                                          (p[1] - p[0]).norm()};
      const int apex = static_cast<int>(std::max_element(edge.begin(), edge.end()) - edge.begin());
      const double area_mm2 = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
      if (area_mm2 <= max_area_mm2 && edge[apex] <= max_edge_mm) {
        nodes_[t.node].child = -static_cast<std::int32_t>(patches_.size()) - 1;
        patches_.push_back(t.vertex);
        facet_idx_.push_back(f);
        if (patches_.size() > max_patches) {
          std::ostringstream what;
          what << "more than " << max_patches << " patches of " << size_mm << " mm are needed";
          throw std::length_error(what.str());
        }
        continue;
      }
      const int a = t.vertex[apex];
      const int b = t.vertex[(apex + 1) % 3];
      const int c = t.vertex[(apex + 2) % 3];
      const int m = middle(b, c);
      const std::int32_t child = static_cast<std::int32_t>(nodes_.size());
      nodes_[t.node] = {child, static_cast<std::uint8_t>(apex)};
      nodes_.push_back({0, 0});
      nodes_.push_back({0, 0});
      open.push_back({child + 1, f, {a, m, c}});
      open.push_back({child, f, {a, b, m}});
    }
  }
}

std::array<Eigen::Vector3d, 3> PatchMesh::corners_mm(int patch) const {
  const auto& v = vertex_idx(patch);
  return {vertices_mm_[v[0]], vertices_mm_[v[1]], vertices_mm_[v[2]]};
}

Eigen::Vector3d PatchMesh::center_mm(int patch) const {
  const auto p = corners_mm(patch);
  return (p[0] + p[1] + p[2]) / 3.0;
}

double PatchMesh::area_mm2(int patch) const {
  const auto p = corners_mm(patch);
  return 0.5 * (p[1] - p[0]).cross(p[2] - p[0]).norm();
}

template <int kColumns>
int PatchMesh::descend(int facet, Eigen::Matrix<double, 3, kColumns>& weights) const {
  using Row = Eigen::Matrix<double, 1, kColumns>;
  std::int32_t node = facet;
  while (nodes_[node].child > 0) {
    constexpr std::array<std::array<Eigen::Index, 2>, 3> kOthers = {{{1, 2}, {2, 0}, {0, 1}}};
    const std::uint8_t apex = nodes_[node].apex;
    const std::array<Eigen::Index, 2>& other = kOthers[apex];
    // With m = (b + c) / 2:  wa a + wb b + wc c = wa a + (wb - wc) b + 2 wc m
    //                                           = wa a + 2 wb m + (wc - wb) c.
    // Without a branch, which would be mispredicted half of the time.
    const int second = weights(other[0], 0) < weights(other[1], 0) ? 1 : 0;
    const Row a = weights.row(apex);
    const Row larger = weights.row(other[static_cast<std::size_t>(second)]);
    const Row smaller = weights.row(other[static_cast<std::size_t>(1 - second)]);
    weights.row(0) = a;
    weights.row(1 + second) = larger - smaller;
    weights.row(2 - second) = 2.0 * smaller;
    node = nodes_[node].child + second;
  }
  return -nodes_[node].child - 1;
}

PatchPoint PatchMesh::locate(int facet, const Eigen::Vector3d& barycentric) const {
  PatchPoint out{-1, barycentric};
  out.patch_idx = descend(facet, out.barycentric);
  return out;
}

int PatchMesh::Finder::patch_idx(int facet, const Eigen::Vector3d& barycentric) {
  // More than rounding, so that points on edges go to the patch that locate() finds.
  constexpr double kInside = 1e-9;
  if (facet == facet_ && (to_patch_ * barycentric).minCoeff() > kInside) return patch_;
  Eigen::Matrix<double, 3, 4> weights;
  weights << barycentric, Eigen::Matrix3d::Identity();
  facet_ = facet;
  patch_ = patches_.descend(facet, weights);
  to_patch_ = weights.rightCols<3>();
  return patch_;
}

}  // namespace scattermeter
