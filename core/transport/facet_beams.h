// A search tree for the facets whose refracted beams contain a point.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// The camera's rays that enter through a facet continue inside as a beam whose direction varies
// slightly over the facet. A point may lie in the beams of several facets (behind convex edges) or
// of none (behind concave ones).
//
// A binary tree over the facets that face the camera. Each node has a sphere around its facets
// (centre c, radius rho) and a cone around its refracted directions (axis d, half angle alpha):
// refraction into the denser side brings directions closer together, by 1 / eta at least, so that a
// facet's directions lie within (its own half angle, seen from the camera) / eta of the one at its
// middle. The node's beams are part of the cone at c, widened by rho, so a point at c + v, with
// t = d . v and r = |v - t d|, is in none of them where
//   r cos(alpha) - t sin(alpha) > rho   or   t < -rho,
// and no ray to it is shorter than |v| - rho. 80 bytes a node, two nodes a facet: 10^6 facets, half
// of them facing the camera, take 150 MB and 1 s to build.
class FacetBeams {
 public:
  // A facet that faces the camera.
  struct Facet {
    int facet_idx;
    bool surely_seen;        // all of it is visible from the camera
    double height_mm;        // of the camera above its plane
    Eigen::Vector3d normal;  // unit, outwards
    Eigen::Vector3d foot;    // of the camera on its plane
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
    search([&](const Node& node) { return node.may_hold(x, within_mm); }, visit);
  }
  // The same where each facet's beam may have turned by up to `turn_rad`, as by refraction at a
  // microfacet with such a tilt: the refracted direction turns by less than the normal.
  template <class Visit>
  void for_turned_candidates(const Eigen::Vector3d& x, double within_mm, double turn_rad,
                             const Visit& visit) const {
    const double sin_turn = std::sin(turn_rad);
    const double cos_turn = std::cos(turn_rad);
    search([&](const Node& node) { return node.may_hold_turned(x, within_mm, sin_turn, cos_turn); },
           visit);
  }

 private:
  template <class MayHold, class Visit>
  void search(const MayHold& may_hold, const Visit& visit) const {
    if (nodes_.empty()) return;
    std::array<int, kDeepest> open;
    int n_open = 0;
    int at = 0;
    if (!may_hold(nodes_[0])) return;
    for (;;) {
      const int first = nodes_[static_cast<std::size_t>(at)].first;
      if (first < 0) {
        visit(facets_[static_cast<std::size_t>(-first - 1)]);
      } else {
        const bool left = may_hold(nodes_[static_cast<std::size_t>(first)]);
        const bool right = may_hold(nodes_[static_cast<std::size_t>(first) + 1]);
        if (left) {
          if (right) open[static_cast<std::size_t>(n_open++)] = first + 1;
          at = first;
          continue;
        }
        if (right) {
          at = first + 1;
          continue;
        }
      }
      if (n_open == 0) return;
      at = open[static_cast<std::size_t>(--n_open)];
    }
  }

  static constexpr int kDeepest = 64;  // depth of the tree for 2^31 facets

  struct Node {
    Eigen::Vector3d center;
    double radius_mm;
    Eigen::Vector3d axis;  // zero where the directions fill half a sphere or more: no cone
    double sin_half;
    double cos2_half;
    int first;  // of two adjacent children; a leaf: -facet - 1
    bool may_hold(const Eigen::Vector3d& x, double within_mm) const {
      const Eigen::Vector3d v = x - center;
      const double v2 = v.squaredNorm();
      const double reach_mm = within_mm + radius_mm;
      if (v2 > reach_mm * reach_mm) return false;
      const double t = v.dot(axis);
      const double radius_at_t_mm = radius_mm + t * sin_half;
      if (t < -radius_mm || radius_at_t_mm < 0.0) return false;
      return (v2 - t * t) * cos2_half <= radius_at_t_mm * radius_at_t_mm;
    }
    // With a cone wider by an angle below a right one.
    bool may_hold_turned(const Eigen::Vector3d& x, double within_mm, double sin_turn,
                         double cos_turn) const {
      constexpr double kWide = 0.07;  // the cosine of 1.5, as in node_around()
      const double cos_half = std::sqrt(cos2_half);
      const double cos_wider = cos_half * cos_turn - sin_half * sin_turn;
      Node wider = *this;
      if (cos2_half == 0.0 || cos_wider < kWide) {
        wider.axis.setZero();
        wider.sin_half = wider.cos2_half = 0.0;
      } else {
        wider.sin_half = sin_half * cos_turn + cos_half * sin_turn;
        wider.cos2_half = cos_wider * cos_wider;
      }
      return wider.may_hold(x, within_mm);
    }
  };

  struct Beam;  // of a facet, while the tree grows
  void grow(const TriangleMesh& mesh, std::vector<Beam>& beams, double reach_mm);
  Node node_around(const TriangleMesh& mesh, const Beam* from, const Beam* to) const;

  std::vector<Facet> facets_;
  std::vector<Node> nodes_;
  double round_mm_ = 0;
};

}  // namespace scattermeter
