#include "apps/deviations/cut_mesh.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

namespace scattermeter::apps {
namespace {

// Vertices closer than this to the plane are on it; two of the result are one.
constexpr double kOnPlane_mm = 1e-6;
constexpr double kOneVertex_mm = 1e-5;

// Cuts triangles one by one; vertices on the plane are shared, so that the rim closes.
class MeshCutter {
 public:
  MeshCutter(const TriangleMesh& mesh, const Eigen::Vector3d& normal, double offset_mm)
      : mesh_(mesh), normal_(normal) {
    out_.vertices_mm = mesh.vertices_mm;
    for (const Eigen::Vector3d& v : mesh.vertices_mm) {
      const double beyond = normal.dot(v) - offset_mm;
      beyond_mm_.push_back(std::abs(beyond) < kOnPlane_mm ? 0.0 : beyond);
    }
  }

  TriangleMesh cut() {
    for (const auto& triangle : mesh_.triangles) add_part(triangle);
    if (out_.triangles.empty()) throw std::invalid_argument("cut_mesh: nothing is left");
    if (!rim_.empty()) close_rim();
    return without_unused();
  }

 private:
  double beyond(int vertex) const { return beyond_mm_[static_cast<std::size_t>(vertex)]; }

  void add_part(const std::array<int, 3>& triangle) {
    std::vector<int> part;
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangle[k];
      const int b = triangle[(k + 1) % 3];
      if (beyond(a) <= 0.0) part.push_back(a);
      if (beyond(a) * beyond(b) < 0.0) part.push_back(crossing(a, b));
    }
    const bool was_cut =
        std::any_of(triangle.begin(), triangle.end(), [&](int v) { return beyond(v) > 0.0; });
    if (was_cut) {
      for (int v : part) {
        if (v >= static_cast<int>(beyond_mm_.size()) || beyond(v) == 0.0) rim_.insert(v);
      }
    }
    const bool in_plane =
        std::all_of(triangle.begin(), triangle.end(), [&](int v) { return beyond(v) >= 0.0; });
    if (part.size() < 3 || (was_cut && in_plane)) return;
    for (std::size_t k = 2; k < part.size(); ++k) {
      out_.triangles.push_back({part[0], part[k - 1], part[k]});
    }
  }

  int crossing(int a, int b) {
    const auto [it, is_new] = crossings_.try_emplace(std::minmax(a, b), 0);
    if (is_new) {
      const int low = it->first.first;
      const int high = it->first.second;
      const double t = beyond(low) / (beyond(low) - beyond(high));
      it->second = static_cast<int>(out_.vertices_mm.size());
      out_.vertices_mm.push_back((1.0 - t) * mesh_.vertices_mm[static_cast<std::size_t>(low)] +
                                 t * mesh_.vertices_mm[static_cast<std::size_t>(high)]);
    }
    return it->second;
  }

  // A fan about the centre of the rim, which is convex.
  void close_rim() {
    const std::vector<Eigen::Vector3d>& x = out_.vertices_mm;
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int v : rim_) centre += x[static_cast<std::size_t>(v)];
    centre /= static_cast<double>(rim_.size());
    const Eigen::Vector3d across = normal_.unitOrthogonal();
    const Eigen::Vector3d up = normal_.cross(across);
    std::vector<std::pair<double, int>> order;
    for (int v : rim_) {
      const Eigen::Vector3d d = x[static_cast<std::size_t>(v)] - centre;
      order.emplace_back(std::atan2(up.dot(d), across.dot(d)), v);
    }
    std::sort(order.begin(), order.end());
    const int middle = static_cast<int>(out_.vertices_mm.size());
    out_.vertices_mm.push_back(centre);
    for (std::size_t k = 0; k < order.size(); ++k) {
      out_.triangles.push_back({middle, order[k].second, order[(k + 1) % order.size()].second});
    }
  }

  // Without unused vertices, and with those that nearly coincide as one.
  TriangleMesh without_unused() const {
    TriangleMesh out;
    std::map<int, int> number;
    const auto number_of = [&](int vertex) {
      const auto [it, is_new] = number.try_emplace(vertex, 0);
      if (!is_new) return it->second;
      const Eigen::Vector3d& x = out_.vertices_mm[static_cast<std::size_t>(vertex)];
      const auto same = std::find_if(
          out.vertices_mm.begin(), out.vertices_mm.end(),
          [&](const Eigen::Vector3d& other) { return (other - x).norm() < kOneVertex_mm; });
      it->second = static_cast<int>(same - out.vertices_mm.begin());
      if (same == out.vertices_mm.end()) out.vertices_mm.push_back(x);
      return it->second;
    };
    for (const auto& t : out_.triangles) {
      const std::array<int, 3> n = {number_of(t[0]), number_of(t[1]), number_of(t[2])};
      if (n[0] != n[1] && n[1] != n[2] && n[2] != n[0]) out.triangles.push_back(n);
    }
    return out;
  }

  const TriangleMesh& mesh_;
  Eigen::Vector3d normal_;
  std::vector<double> beyond_mm_;  // of each vertex of the mesh; exactly 0 on the plane
  TriangleMesh out_;
  std::map<std::pair<int, int>, int> crossings_;
  std::set<int> rim_;
};

struct BevelPlane {
  Eigen::Vector3d normal;
  double offset_mm;
};

// One for each pair of faces that meet at an edge; the triangles of a face give the same.
std::vector<BevelPlane> bevels(const TriangleMesh& mesh, double leg_mm) {
  std::map<std::pair<int, int>, int> left;  // directed edge -> triangle
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      left[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = static_cast<int>(t);
    }
  }
  std::vector<BevelPlane> out;
  for (const auto& [edge, triangle] : left) {
    if (edge.first > edge.second) continue;
    const Eigen::Vector3d n1 = area_vector_mm2(mesh, triangle).normalized();
    const Eigen::Vector3d n2 =
        area_vector_mm2(mesh, left.at({edge.second, edge.first})).normalized();
    const double bend = std::acos(std::clamp(n1.dot(n2), -1.0, 1.0));
    if (bend < 20.0 * std::numbers::pi / 180.0) continue;
    const Eigen::Vector3d normal = (n1 + n2).normalized();
    const Eigen::Vector3d& on_edge = mesh.vertices_mm[static_cast<std::size_t>(edge.first)];
    out.push_back({normal, normal.dot(on_edge) - leg_mm * std::sin(0.5 * bend)});
  }
  return out;
}

}  // namespace

TriangleMesh cut_mesh(const TriangleMesh& mesh, const Eigen::Vector3d& normal, double offset_mm) {
  return MeshCutter(mesh, normal, offset_mm).cut();
}

TriangleMesh bevelled_mesh(const TriangleMesh& mesh, double leg_mm) {
  TriangleMesh out = merge_equal_vertices(mesh);
  for (const BevelPlane& plane : bevels(out, leg_mm)) {
    out = cut_mesh(out, plane.normal, plane.offset_mm);
  }
  return out;
}

TriangleMesh chipped_mesh(const TriangleMesh& mesh, const Eigen::Vector3d& direction,
                          double depth_mm) {
  double farthest = -std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3d& v : mesh.vertices_mm) farthest = std::max(farthest, direction.dot(v));
  return cut_mesh(merge_equal_vertices(mesh), direction, farthest - depth_mm);
}

}  // namespace scattermeter::apps
