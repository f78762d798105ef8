#include "core/mesh/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

std::string text(const Eigen::Vector3d& v) {
  std::ostringstream out;
  out << "[" << v.x() << ", " << v.y() << ", " << v.z() << "]";
  return out.str();
}

// Problems of single vertices and triangles.
std::string element_problem(const TriangleMesh& mesh) {
  if (mesh.triangles.empty()) return "the mesh has no faces";
  const int n = static_cast<int>(mesh.vertices_mm.size());
  for (const Eigen::Vector3d& v : mesh.vertices_mm) {
    if (!v.allFinite()) return "a vertex is not finite: " + text(v);
  }
  for (const auto& t : mesh.triangles) {
    for (int i : t) {
      if (i < 0 || i >= n)
        return "a face names vertex " + std::to_string(i) + " of " + std::to_string(n);
    }
  }
  return "";
}

// Every directed edge must occur once, and its reverse once.
std::string topology_problem(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> count;
  for (const auto& t : mesh.triangles) {
    for (int e = 0; e < 3; ++e) ++count[{t[e], t[(e + 1) % 3]}];
  }
  std::size_t open = 0;
  std::pair<int, int> example;
  for (const auto& [edge, times] : count) {
    const auto reverse = count.find({edge.second, edge.first});
    const int back = reverse == count.end() ? 0 : reverse->second;
    if (times > 1 && back != times) {
      return "the faces at the edge from " + text(mesh.vertices_mm[edge.first]) + " to " +
             text(mesh.vertices_mm[edge.second]) + " are not consistently oriented";
    }
    if (times > 1) {
      return "more than two faces share the edge from " + text(mesh.vertices_mm[edge.first]) +
             " to " + text(mesh.vertices_mm[edge.second]);
    }
    if (back == 0) {
      if (open == 0) example = edge;
      ++open;
    }
  }
  if (open > 0) {
    return "the mesh is open: " + std::to_string(open) +
           " edges belong to one face only, the first from " +
           text(mesh.vertices_mm[example.first]) + " to " + text(mesh.vertices_mm[example.second]);
  }
  return "";
}

}  // namespace

Eigen::Vector3d area_vector_mm2(const TriangleMesh& mesh, int triangle_idx) {
  const auto& t = mesh.triangles[static_cast<std::size_t>(triangle_idx)];
  const Eigen::Vector3d& a = mesh.vertices_mm[t[0]];
  return 0.5 * (mesh.vertices_mm[t[1]] - a).cross(mesh.vertices_mm[t[2]] - a);
}

double signed_volume_mm3(const TriangleMesh& mesh) {
  // Relative to the first vertex: keeps the digits of a mesh far from the origin.
  if (mesh.vertices_mm.empty()) return 0.0;
  const Eigen::Vector3d o = mesh.vertices_mm.front();
  double six_volumes = 0.0;
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices_mm[t[0]] - o;
    const Eigen::Vector3d b = mesh.vertices_mm[t[1]] - o;
    const Eigen::Vector3d c = mesh.vertices_mm[t[2]] - o;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

Box3d bounds(const TriangleMesh& mesh) {
  if (mesh.vertices_mm.empty()) throw std::invalid_argument("bounds: the mesh has no vertices");
  Box3d box{mesh.vertices_mm.front(), mesh.vertices_mm.front()};
  for (const Eigen::Vector3d& v : mesh.vertices_mm) {
    box.min_mm = box.min_mm.cwiseMin(v);
    box.max_mm = box.max_mm.cwiseMax(v);
  }
  return box;
}

TriangleMesh merge_equal_vertices(const TriangleMesh& mesh) {
  TriangleMesh merged;
  std::map<std::tuple<double, double, double>, int> index_of;
  std::vector<int> new_idx(mesh.vertices_mm.size());
  for (std::size_t i = 0; i < mesh.vertices_mm.size(); ++i) {
    const Eigen::Vector3d& v = mesh.vertices_mm[i];
    // Adding 0 turns -0 into 0; NaN never compares, so it is kept apart by its own index.
    const std::tuple<double, double, double> key{v.x() + 0.0, v.y() + 0.0, v.z() + 0.0};
    if (!v.allFinite()) {
      new_idx[i] = static_cast<int>(merged.vertices_mm.size());
      merged.vertices_mm.push_back(v);
      continue;
    }
    const auto [it, is_new] =
        index_of.try_emplace(key, static_cast<int>(merged.vertices_mm.size()));
    if (is_new) merged.vertices_mm.push_back(v);
    new_idx[i] = it->second;
  }
  merged.triangles = mesh.triangles;
  for (auto& t : merged.triangles) {
    for (int& i : t) i = new_idx[static_cast<std::size_t>(i)];
  }
  return merged;
}

TriangleMesh cut_finer(TriangleMesh mesh, int levels) {
  for (; levels > 0; --levels) {
    TriangleMesh finer;
    finer.vertices_mm = mesh.vertices_mm;
    std::map<std::pair<int, int>, int> middle_of;
    const auto middle = [&](int a, int b) {
      const auto key = std::minmax(a, b);
      const auto [it, is_new] =
          middle_of.try_emplace(key, static_cast<int>(finer.vertices_mm.size()));
      if (is_new) {
        finer.vertices_mm.emplace_back(0.5 *
                                       (mesh.vertices_mm[static_cast<std::size_t>(key.first)] +
                                        mesh.vertices_mm[static_cast<std::size_t>(key.second)]));
      }
      return it->second;
    };
    for (const auto& t : mesh.triangles) {
      const int a = middle(t[0], t[1]);
      const int b = middle(t[1], t[2]);
      const int c = middle(t[2], t[0]);
      finer.triangles.push_back({t[0], a, c});
      finer.triangles.push_back({a, t[1], b});
      finer.triangles.push_back({c, b, t[2]});
      finer.triangles.push_back({a, b, c});
    }
    mesh = std::move(finer);
  }
  return mesh;
}

std::string mesh_problem(const TriangleMesh& original, const MeshCheckOptions& options) {
  if (std::string problem = element_problem(original); !problem.empty()) return problem;
  const TriangleMesh mesh = merge_equal_vertices(original);
  const Box3d box = bounds(mesh);
  const double size_mm = box.size_mm().maxCoeff();
  if (size_mm < options.min_size_mm) {
    std::ostringstream out;
    out << "the object is only " << size_mm
        << " mm long; coordinates are taken as mm (is the file in "
        << "metres?)";
    return out.str();
  }
  if (size_mm > options.max_size_mm) {
    std::ostringstream out;
    out << "the object is " << size_mm << " mm long, more than " << options.max_size_mm
        << " mm; coordinates are taken as mm (is the file in micrometres?)";
    return out.str();
  }
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) {
    // An area below the rounding error of its own coordinates counts as zero.
    const auto& tri = mesh.triangles[static_cast<std::size_t>(t)];
    const double longest = std::max({(mesh.vertices_mm[tri[1]] - mesh.vertices_mm[tri[0]]).norm(),
                                     (mesh.vertices_mm[tri[2]] - mesh.vertices_mm[tri[1]]).norm(),
                                     (mesh.vertices_mm[tri[0]] - mesh.vertices_mm[tri[2]]).norm()});
    if (area_vector_mm2(mesh, t).norm() <= 1e-12 * longest * longest) {
      return "face " + std::to_string(t) + " (after triangulation) has no area, at " +
             text(mesh.vertices_mm[tri[0]]);
    }
  }
  if (std::string problem = topology_problem(mesh); !problem.empty()) return problem;
  const double volume_mm3 = signed_volume_mm3(mesh);
  if (!(volume_mm3 > 0.0)) {
    std::ostringstream out;
    out << "the faces point inwards (enclosed volume " << volume_mm3 << " mm^3)";
    return out.str();
  }
  return "";
}

}  // namespace scattermeter
