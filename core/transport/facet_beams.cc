#include "core/transport/facet_beams.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <Eigen/Geometry>

#include "core/material/smooth_boundary.h"
#include "core/mesh/facet_visibility.h"

namespace scattermeter {
namespace {

constexpr double kRound = 1e-9;  // of the body's size, and rad
// Of the body's size: how far along a beam its direction counts when facets are split into halves.
constexpr double kReach = 0.05;

double angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

struct FacetBeams::Beam {
  int facet;  // index into facets_
  Eigen::Vector3d middle;
  Eigen::Vector3d direction;  // refracted there
  double half_angle;
};

FacetBeams::FacetBeams(const TriangleMesh& mesh, const Eigen::Vector3d& camera_in_world_mm,
                       double eta_int_over_ext) {
  if (!(eta_int_over_ext >= 1.0)) {
    throw std::invalid_argument("FacetBeams: eta_int_over_ext = " +
                                std::to_string(eta_int_over_ext));
  }
  const double size_mm = bounds(mesh).size_mm().maxCoeff();
  round_mm_ = kRound * size_mm;
  const std::vector<bool> seen = surely_seen(mesh, camera_in_world_mm);
  std::vector<Beam> beams;
  for (int f = 0; f < static_cast<int>(mesh.triangles.size()); ++f) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(f)];
    const Eigen::Vector3d normal = area_vector_mm2(mesh, f).normalized();
    const Eigen::Vector3d& a = mesh.vertices_mm[static_cast<std::size_t>(t[0])];
    const double height_mm = normal.dot(camera_in_world_mm - a);
    if (!(height_mm > 0.0)) continue;
    Beam beam{static_cast<int>(facets_.size()), Eigen::Vector3d::Zero(), {}, 0.0};
    for (int i : t) beam.middle += mesh.vertices_mm[static_cast<std::size_t>(i)] / 3.0;
    const Eigen::Vector3d ray = (beam.middle - camera_in_world_mm).normalized();
    for (int i : t) {
      const Eigen::Vector3d to = mesh.vertices_mm[static_cast<std::size_t>(i)] - camera_in_world_mm;
      beam.half_angle = std::max(beam.half_angle, angle(ray, to) / eta_int_over_ext);
    }
    beam.half_angle += kRound;
    beam.direction = refracted(ray, normal, eta_int_over_ext).normalized();
    beams.push_back(beam);
    facets_.push_back({f, seen[static_cast<std::size_t>(f)], height_mm, normal,
                       camera_in_world_mm - height_mm * normal});
  }
  if (!beams.empty()) grow(mesh, beams, kReach * size_mm);
}

void FacetBeams::grow(const TriangleMesh& mesh, std::vector<Beam>& beams, double reach_mm) {
  struct Open {
    int node;
    std::size_t from, to;
  };
  nodes_.reserve(2 * beams.size() - 1);
  nodes_.push_back(node_around(mesh, beams.data(), beams.data() + beams.size()));
  std::vector<Open> open = {{0, 0, beams.size()}};
  while (!open.empty()) {
    const Open o = open.back();
    open.pop_back();
    if (o.to - o.from == 1) {
      nodes_[static_cast<std::size_t>(o.node)].first = -beams[o.from].facet - 1;
      continue;
    }
    // Halves along the widest of three coordinates of position and three of direction.
    const auto coordinate = [&](const Beam& b, int axis) {
      return axis < 3 ? b.middle[axis] : reach_mm * b.direction[axis - 3];
    };
    int widest = 0;
    double most_mm = -1.0;
    for (int axis = 0; axis < 6; ++axis) {
      double low = std::numeric_limits<double>::infinity();
      double high = -low;
      for (std::size_t i = o.from; i < o.to; ++i) {
        low = std::min(low, coordinate(beams[i], axis));
        high = std::max(high, coordinate(beams[i], axis));
      }
      if (high - low > most_mm) {
        most_mm = high - low;
        widest = axis;
      }
    }
    const std::size_t half = o.from + (o.to - o.from) / 2;
    const auto at = [&](std::size_t i) { return beams.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(o.from), at(half), at(o.to), [&](const Beam& a, const Beam& b) {
      const double ca = coordinate(a, widest);
      const double cb = coordinate(b, widest);
      return ca != cb ? ca < cb : a.facet < b.facet;
    });
    const int first = static_cast<int>(nodes_.size());
    nodes_[static_cast<std::size_t>(o.node)].first = first;
    nodes_.push_back(node_around(mesh, &beams[o.from], &beams[half]));
    nodes_.push_back(node_around(mesh, &beams[half], beams.data() + o.to));
    open.push_back({first + 1, half, o.to});
    open.push_back({first, o.from, half});
  }
}

FacetBeams::Node FacetBeams::node_around(const TriangleMesh& mesh, const Beam* from,
                                         const Beam* to) const {
  const auto for_corners = [&](const auto& call) {
    for (const Beam* b = from; b != to; ++b) {
      const int facet = facets_[static_cast<std::size_t>(b->facet)].facet_idx;
      for (int i : mesh.triangles[static_cast<std::size_t>(facet)]) {
        call(mesh.vertices_mm[static_cast<std::size_t>(i)]);
      }
    }
  };
  Eigen::Vector3d low = from->middle;
  Eigen::Vector3d high = low;
  for_corners([&](const Eigen::Vector3d& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  });
  Node node{};
  node.center = to - from == 1 ? from->middle : Eigen::Vector3d(0.5 * (low + high));
  for_corners([&](const Eigen::Vector3d& p) {
    node.radius_mm = std::max(node.radius_mm, (p - node.center).norm());
  });
  node.radius_mm += round_mm_;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Beam* b = from; b != to; ++b) sum += b->direction;
  double half_angle = 0.0;
  for (const Beam* b = from; b != to; ++b) {
    half_angle = std::max(half_angle, angle(sum, b->direction) + b->half_angle);
  }
  constexpr double kWide = 1.5;  // rad; the bound is valid below a right angle
  const bool cone = half_angle < kWide && sum.norm() > 0.0;
  node.axis = cone ? Eigen::Vector3d(sum.normalized()) : Eigen::Vector3d::Zero();
  node.sin_half = cone ? std::sin(half_angle) : 0.0;
  node.cos2_half = cone ? std::pow(std::cos(half_angle), 2) : 0.0;
  return node;
}

}  // namespace scattermeter
