#include "core/mesh/visible_edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

namespace scattermeter {
namespace {

// To the side of an edge where nothing else can be, in sizes of the body.
constexpr double kBeside = 2e-4;
constexpr double kEdgeInset = 0.1;  // of a piece's half: rays at its ends fall inside the edge

struct MeshEdge {
  std::array<Eigen::Vector3d, 2> end_mm;
  std::array<int, 2> facet;
  int line_idx;
  std::array<Eigen::Vector3d, 2> line_end_mm;
};

// Edges in the order in which the triangles name them first.
std::vector<MeshEdge> edges_of(const TriangleMesh& mesh, double size_mm) {
  std::vector<MeshEdge> edges;
  std::map<std::pair<int, int>, std::size_t> by_ends;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      const auto [it, is_new] = by_ends.try_emplace(std::minmax(a, b), edges.size());
      if (is_new) {
        const std::array<Eigen::Vector3d, 2> ends = {mesh.vertices_mm[static_cast<std::size_t>(a)],
                                                     mesh.vertices_mm[static_cast<std::size_t>(b)]};
        edges.push_back({ends, {static_cast<int>(f), -1}, 0, ends});
      } else {
        edges[it->second].facet[1] = static_cast<int>(f);
      }
    }
  }
  // Lines are the same when direction and foot of the perpendicular from the origin agree.
  using Key = std::array<std::int64_t, 6>;
  std::map<Key, int> lines;
  std::vector<std::array<Eigen::Vector3d, 2>> line_ends;
  for (MeshEdge& e : edges) {
    Eigen::Vector3d u = (e.end_mm[1] - e.end_mm[0]).normalized();
    int major = 0;
    u.cwiseAbs().maxCoeff(&major);
    if (u[major] < 0) u = -u;
    const Eigen::Vector3d foot = e.end_mm[0] - u.dot(e.end_mm[0]) * u;
    Key key{};
    for (int i = 0; i < 3; ++i) {
      key[static_cast<std::size_t>(i)] = std::llround(1e4 * u[i]);
      key[static_cast<std::size_t>(3 + i)] = std::llround(1e3 * foot[i] / size_mm);
    }
    const auto [line, is_new] = lines.try_emplace(key, static_cast<int>(lines.size()));
    e.line_idx = line->second;
    if (is_new) line_ends.push_back({e.end_mm[0], e.end_mm[0]});
    auto& [first, last] = line_ends[static_cast<std::size_t>(e.line_idx)];
    for (const Eigen::Vector3d& end : e.end_mm) {
      if (end[major] < first[major]) first = end;
      if (end[major] > last[major]) last = end;
    }
  }
  for (MeshEdge& e : edges) e.line_end_mm = line_ends[static_cast<std::size_t>(e.line_idx)];
  return edges;
}

// What a ray beside an edge meets.
enum class Beside { kNothing, kFarther, kNearer, kFacet };

class EdgeRays {
 public:
  EdgeRays(const RayScene& scene, const TriangleMesh& mesh, const Eigen::Vector3d& eye_mm,
           double size_mm, double cos_smooth)
      : scene_(scene), eye_mm_(eye_mm), size_mm_(size_mm), cos_smooth_(cos_smooth) {
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
      normals_.push_back(area_vector_mm2(mesh, static_cast<int>(f)).normalized());
      faces_eye_.push_back(
          normals_.back().dot(
              eye_mm - mesh.vertices_mm[static_cast<std::size_t>(mesh.triangles[f][0])]) > 0);
    }
  }

  const Eigen::Vector3d& normal(int facet) const {
    return normals_[static_cast<std::size_t>(facet)];
  }
  bool faces_eye(int facet) const { return faces_eye_[static_cast<std::size_t>(facet)]; }

  // At `target_mm`, beside `edge_mm` where `facet` begins.
  Beside look(const Eigen::Vector3d& target_mm, const Eigen::Vector3d& edge_mm, int facet) const {
    const Eigen::Vector3d direction = target_mm - eye_mm_;
    const RayHit hit = scene_.first_hit(eye_mm_, direction);
    if (hit.facet_idx < 0) return Beside::kNothing;
    const Eigen::Vector3d x = eye_mm_ + hit.distance * direction;
    const double off_mm = std::abs(normal(facet).dot(x - edge_mm));
    if (normal(hit.facet_idx).dot(normal(facet)) >= cos_smooth_ &&
        off_mm <= std::max(1e-3 * size_mm_, 0.3 * (x - edge_mm).norm())) {
      return Beside::kFacet;
    }
    return hit.distance > 1.0 ? Beside::kFarther : Beside::kNearer;
  }

 private:
  const RayScene& scene_;
  Eigen::Vector3d eye_mm_;
  double size_mm_;
  double cos_smooth_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<bool> faces_eye_;
};

// The kind at one point of an edge with `inner` facet on the side against `outward`; none: not
// seen. outer: the other facet of a crease, or -1.
std::optional<EdgeKind> kind_at(const EdgeRays& rays, const Eigen::Vector3d& at_mm,
                                const Eigen::Vector3d& outward, double beside_mm, int inner,
                                int outer) {
  if (rays.look(at_mm - beside_mm * outward, at_mm, inner) != Beside::kFacet) return std::nullopt;
  const Beside outside = rays.look(at_mm + beside_mm * outward, at_mm, outer >= 0 ? outer : inner);
  if (outer >= 0) {
    if (outside == Beside::kFacet) return EdgeKind::kCrease;
    return std::nullopt;
  }
  if (outside == Beside::kNothing) return EdgeKind::kContour;
  if (outside == Beside::kFarther) return EdgeKind::kStep;
  return std::nullopt;
}

}  // namespace

std::vector<EdgePiece> visible_edges(const RayScene& scene, const Eigen::Vector3d& eye_mm,
                                     const VisibleEdgesOptions& options) {
  if (!(options.step_rad > 0) || !(options.clearance_rad >= 0) || !(options.crease_rad > 0)) {
    throw std::invalid_argument(
        "visible_edges: step_rad and crease_rad must be > 0, "
        "clearance_rad >= 0");
  }
  const TriangleMesh mesh = merge_equal_vertices(scene.mesh());
  const double size_mm = bounds(mesh).size_mm().maxCoeff();
  const EdgeRays rays(scene, mesh, eye_mm, size_mm, std::cos(options.crease_rad));
  std::vector<EdgePiece> pieces;
  for (const MeshEdge& e : edges_of(mesh, size_mm)) {
    if (e.facet[1] < 0) continue;
    const bool first = rays.faces_eye(e.facet[0]);
    const bool second = rays.faces_eye(e.facet[1]);
    if (!first && !second) continue;
    const bool both = first && second;
    if (both &&
        rays.normal(e.facet[0]).dot(rays.normal(e.facet[1])) >= std::cos(options.crease_rad)) {
      continue;
    }
    const int inner = first ? e.facet[0] : e.facet[1];
    const int outer = both ? e.facet[1] : -1;
    const Eigen::Vector3d along = e.end_mm[1] - e.end_mm[0];
    const double distance_mm = (0.5 * (e.end_mm[0] + e.end_mm[1]) - eye_mm).norm();
    // As seen: the part of it across the line of sight.
    const Eigen::Vector3d sight = (0.5 * (e.end_mm[0] + e.end_mm[1]) - eye_mm).normalized();
    const double seen_rad = along.cross(sight).norm() / distance_mm;
    if (seen_rad == 0) continue;
    const int n = std::max(1, static_cast<int>(std::ceil(seen_rad / options.step_rad)));
    for (int i = 0; i < n; ++i) {
      EdgePiece piece;
      piece.line_idx = e.line_idx;
      piece.line_end_mm = e.line_end_mm;
      piece.center_mm = e.end_mm[0] + along * ((i + 0.5) / n);
      piece.half_mm = along * (0.5 / n);
      piece.outward = along.cross(piece.center_mm - eye_mm).normalized();
      // A facet lies on the side of its own third corner: n x along points into the facet.
      const Eigen::Vector3d into_inner =
          rays.normal(inner).cross(inner == e.facet[0] ? along : -along);
      if (piece.outward.dot(into_inner) > 0) piece.outward = -piece.outward;
      std::optional<EdgeKind> kind;
      bool is_seen = true;
      std::vector<double> sides_mm = {kBeside * size_mm};
      if (options.clearance_rad > 0) sides_mm.push_back(options.clearance_rad * distance_mm);
      if (options.clearance_rad > 0) {
        sides_mm.push_back(0.5 * options.clearance_rad * distance_mm);
      }
      for (const double side_mm : sides_mm) {
        for (const double t : {0.0, -1.0 + kEdgeInset, 1.0 - kEdgeInset}) {
          const auto here = kind_at(rays, piece.center_mm + t * piece.half_mm, piece.outward,
                                    side_mm, inner, outer);
          if (!here || (kind && *kind != *here)) is_seen = false;
          if (!kind) kind = here;
          if (!is_seen) break;
        }
        if (!is_seen) break;
      }
      if (!is_seen) continue;
      piece.kind = *kind;
      pieces.push_back(piece);
    }
  }
  return pieces;
}

}  // namespace scattermeter
