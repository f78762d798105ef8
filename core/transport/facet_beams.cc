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

constexpr double kRound = 1e-6;  // of the body's size, and rad
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
  const Box3d box = bounds(mesh);
  const double size_mm = box.size_mm().maxCoeff();
  origin_mm_ = box.center_mm();
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
    Facet facet{.facet_idx = f,
                .surely_seen = seen[static_cast<std::size_t>(f)],
                .height_mm = height_mm,
                .normal = normal,
                .foot = camera_in_world_mm - height_mm * normal,
                .inward = {},
                .edge = {}};
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d& from = mesh.vertices_mm[static_cast<std::size_t>(t[i])];
      const Eigen::Vector3d& to = mesh.vertices_mm[static_cast<std::size_t>(t[(i + 1) % 3])];
      facet.inward[i] = normal.cross(to - from);
      facet.edge[i] = facet.inward[i].dot(from);
    }
    facets_.push_back(facet);
  }
  if (!beams.empty()) grow(mesh, beams, kReach * size_mm);
}

struct FacetBeams::Bounds {
  Eigen::Vector3d center;
  double radius_mm = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  double sin_half = 0;
  double cos2_half = 0;
};

void FacetBeams::grow(const TriangleMesh& mesh, std::vector<Beam>& beams, double reach_mm) {
  struct Range {
    std::size_t from, to;
    std::size_t size() const { return to - from; }
  };
  // The middle of a range, halved along the widest of three coordinates of position and three of
  // direction.
  const auto halved = [&](const Range& o) {
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
    const std::size_t half = o.from + o.size() / 2;
    const auto at = [&](std::size_t i) { return beams.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(o.from), at(half), at(o.to), [&](const Beam& a, const Beam& b) {
      const double ca = coordinate(a, widest);
      const double cb = coordinate(b, widest);
      return ca != cb ? ca < cb : a.facet < b.facet;
    });
    return half;
  };
  const auto empty_node = [] {
    constexpr float kFarAway = 1e15F;
    Node node;
    for (Lanes& c : node.center) c.setConstant(kFarAway);
    for (Lanes& a : node.axis) a.setZero();
    node.radius_mm.setConstant(-1.0F);
    node.sin_half.setZero();
    node.cos2_half.setZero();
    node.child.fill(0);
    return node;
  };
  struct Open {
    std::size_t node;
    Range range;
  };
  nodes_.push_back(empty_node());
  std::vector<Open> open = {{0, {0, beams.size()}}};
  while (!open.empty()) {
    const Open o = open.back();
    open.pop_back();
    std::vector<Range> parts = {o.range};
    while (parts.size() < kChildren) {
      Range& largest =
          *std::max_element(parts.begin(), parts.end(),
                            [](const Range& a, const Range& b) { return a.size() < b.size(); });
      if (largest.size() < 2) break;
      const Range second{halved(largest), largest.to};
      largest.to = second.from;
      parts.push_back(second);
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Range& part = parts[k];
      int child = -beams[part.from].facet - 1;
      if (part.size() > 1) {
        child = static_cast<int>(nodes_.size());
        open.push_back({nodes_.size(), part});
        nodes_.push_back(empty_node());
      }
      const Bounds of = bounds_of(mesh, &beams[part.from], beams.data() + part.to);
      const auto lane = static_cast<Eigen::Index>(k);
      Node& node = nodes_[o.node];
      const Eigen::Vector3f center = (of.center - origin_mm_).cast<float>();
      const Eigen::Vector3f axis = of.axis.cast<float>();
      for (std::size_t i = 0; i < 3; ++i) {
        node.center[i][lane] = center[static_cast<Eigen::Index>(i)];
        node.axis[i][lane] = axis[static_cast<Eigen::Index>(i)];
      }
      node.radius_mm[lane] = static_cast<float>(of.radius_mm);
      node.sin_half[lane] = static_cast<float>(of.sin_half);
      node.cos2_half[lane] = static_cast<float>(of.cos2_half);
      node.child[k] = child;
    }
  }
}

FacetBeams::Bounds FacetBeams::bounds_of(const TriangleMesh& mesh, const Beam* from,
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
  Bounds out;
  out.center = to - from == 1 ? from->middle : Eigen::Vector3d(0.5 * (low + high));
  for_corners([&](const Eigen::Vector3d& p) {
    out.radius_mm = std::max(out.radius_mm, (p - out.center).norm());
  });
  out.radius_mm += round_mm_;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Beam* b = from; b != to; ++b) sum += b->direction;
  double half_angle = 0.0;
  for (const Beam* b = from; b != to; ++b) {
    half_angle = std::max(half_angle, angle(sum, b->direction) + b->half_angle);
  }
  if (half_angle < kWidest && sum.norm() > 0.0) {
    out.axis = sum.normalized();
    out.sin_half = std::sin(half_angle);
    out.cos2_half = std::pow(std::cos(half_angle), 2);
  }
  return out;
}

}  // namespace scattermeter
