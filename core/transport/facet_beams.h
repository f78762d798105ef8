// A search tree for the facets whose refracted beams contain a point.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// The camera's rays that enter through a facet continue inside as a beam whose direction varies
// slightly over the facet. A point may lie in the beams of several facets (behind convex edges) or
// of none (behind concave ones).
//
// A tree over the facets that face the camera, of four children a node. Each child has a sphere
// around its facets (centre c, radius rho) and a cone around its refracted directions (axis d, half
// angle alpha): refraction into the denser side brings directions closer together, by 1 / eta at
// least, so that a facet's directions lie within (its own half angle, seen from the camera) / eta
// of the one at its middle. The child's beams are part of the cone at c, widened by rho, so a point
// at c + v, with t = d . v and r = |v - t d|, is in none of them where
//   r cos(alpha) - t sin(alpha) > rho   or   t < -rho,
// and no ray to it is shorter than |v| - rho. Numbers are single, relative to the body's centre,
// with room for their rounding. About 210 bytes a facet: 10^6 facets, half of them facing the
// camera, take 110 MB.
class FacetBeams {
 public:
  // A facet that faces the camera.
  struct Facet {
    int facet_idx;
    bool surely_seen;                       // all of it is visible from the camera
    double height_mm;                       // of the camera above its plane
    Eigen::Vector3d normal;                 // unit, outwards
    Eigen::Vector3d foot;                   // of the camera on its plane
    std::array<Eigen::Vector3d, 3> inward;  // in its plane, across each edge
    std::array<double, 3> edge;             // of a point of the edge, along that

    bool is_inside(const Eigen::Vector3d& on_plane, std::size_t of_edge) const {
      return inward[of_edge].dot(on_plane) >= edge[of_edge];
    }
    bool holds(const Eigen::Vector3d& on_plane) const {
      return is_inside(on_plane, 0) && is_inside(on_plane, 1) && is_inside(on_plane, 2);
    }
    // Whether a point of the straight line between two may be on it.
    bool may_hold(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
      for (std::size_t i = 0; i < 3; ++i) {
        if (!is_inside(from, i) && !is_inside(to, i)) return false;
      }
      return true;
    }
  };

  // eta_int_over_ext >= 1, else std::invalid_argument.
  FacetBeams(const TriangleMesh& mesh, const Eigen::Vector3d& camera_in_world_mm,
             double eta_int_over_ext);

  // Facets that face the camera.
  const std::vector<Facet>& facets() const { return facets_; }

  // Calls visit(const Facet&) for every facet whose beam contains x at less than `within_mm` behind
  // the surface, and for some others.
  template <class Visit>
  void for_candidates(const Eigen::Vector3d& x, double within_mm, const Visit& visit) const {
    const Eigen::Vector3f at = (x - origin_mm_).cast<float>();
    search([&](const Node& node) { return node.may_hold(at, static_cast<float>(within_mm)); },
           visit);
  }
  // The same where each facet's beam may have turned by up to `turn_rad`, as by refraction at a
  // microfacet with such a tilt: the refracted direction turns by less than the normal.
  template <class Visit>
  void for_turned_candidates(const Eigen::Vector3d& x, double within_mm, double turn_rad,
                             const Visit& visit) const {
    const Eigen::Vector3f at = (x - origin_mm_).cast<float>();
    const auto sin_turn = static_cast<float>(std::sin(turn_rad));
    const auto cos_turn = static_cast<float>(std::cos(turn_rad));
    search(
        [&](const Node& node) {
          return node.turned(sin_turn, cos_turn).may_hold(at, static_cast<float>(within_mm));
        },
        visit);
  }

 private:
  static constexpr int kChildren = 4;
  using Lanes = Eigen::Array<float, kChildren, 1>;

  struct Node {
    std::array<Lanes, 3> center;
    Lanes radius_mm;            // of a child that is not there: negative, with its centre far off
    std::array<Lanes, 3> axis;  // zero where the directions fill half a sphere or more: no cone
    Lanes sin_half;
    Lanes cos2_half;
    std::array<int, kChildren> child;  // a node; a facet: -facet - 1

    // Bit k: whether a beam of child k may contain x at less than within_mm.
    unsigned may_hold(const Eigen::Vector3f& x, float within_mm) const {
      const Lanes vx = x[0] - center[0], vy = x[1] - center[1], vz = x[2] - center[2];
      const Lanes v2 = vx * vx + vy * vy + vz * vz;
      const Lanes reach_mm = within_mm + radius_mm;
      const Lanes t = vx * axis[0] + vy * axis[1] + vz * axis[2];
      const Lanes radius_at_t_mm = radius_mm + t * sin_half;
      constexpr float kRounding = 1e-6F;  // of v^2, and some more
      // All are negative where the child may hold x. One by one: compilers inline them then.
      const Lanes beyond = v2 - reach_mm * reach_mm;
      const Lanes before = (-t - radius_mm).max(-radius_at_t_mm);
      const Lanes beside = (v2 - t * t) * cos2_half - radius_at_t_mm * radius_at_t_mm;
      const Lanes excess = beyond.max(before).max(beside - kRounding * v2);
      unsigned out = 0;
      for (int k = 0; k < kChildren; ++k) out |= static_cast<unsigned>(excess[k] <= 0.0F) << k;
      return out;
    }
    // The same node with cones that are wider by an angle below a right one.
    Node turned(float sin_turn, float cos_turn) const {
      const Lanes cos_half = cos2_half.sqrt();
      const Lanes cos_wider = cos_half * cos_turn - sin_half * sin_turn;
      const auto is_cone = cos2_half > 0.0F && cos_wider >= kLeastCosine;
      Node wider = *this;
      for (std::size_t i = 0; i < 3; ++i) wider.axis[i] = is_cone.select(axis[i], 0.0F);
      wider.sin_half = is_cone.select(sin_half * cos_turn + cos_half * sin_turn, 0.0F);
      wider.cos2_half = is_cone.select(cos_wider * cos_wider, 0.0F);
      return wider;
    }
  };

  template <class MayHold, class Visit>
  void search(const MayHold& may_hold, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<int, kMostOpen> open;
    int n_open = 0;
    int at = 0;
    for (;;) {
      const Node& node = nodes_[static_cast<std::size_t>(at)];
      for (unsigned holding = may_hold(node); holding != 0; holding &= holding - 1) {
        const int child = node.child[static_cast<std::size_t>(std::countr_zero(holding))];
        if (child < 0) {
          visit(facets_[static_cast<std::size_t>(-child - 1)]);
        } else {
          open[static_cast<std::size_t>(n_open++)] = child;
        }
      }
      if (n_open == 0) return;
      at = open[static_cast<std::size_t>(--n_open)];
    }
  }

  static constexpr int kMostOpen = 64;  // in a tree of 2^31 facets
  // Half of a cone, rad, and its cosine; the bound is valid below a right angle.
  static constexpr double kWidest = 1.5;
  static constexpr float kLeastCosine = 0.0707F;

  struct Beam;  // of a facet, while the tree grows
  struct Bounds;
  void grow(const TriangleMesh& mesh, std::vector<Beam>& beams, double reach_mm);
  Bounds bounds_of(const TriangleMesh& mesh, const Beam* from, const Beam* to) const;

  std::vector<Facet> facets_;
  std::vector<Node> nodes_;
  Eigen::Vector3d origin_mm_ = Eigen::Vector3d::Zero();
  double round_mm_ = 0;
};

}  // namespace scattermeter
