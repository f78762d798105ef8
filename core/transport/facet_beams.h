// A search tree for the facets whose refracted beams contain a point.
#pragma once

#include <array>
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
    if (nodes_.empty()) return;
    std::array<int, kDeepest> open;
    int n_open = 0;
    int at = 0;
    if (!nodes_[0].may_hold(x, within_mm)) return;
    for (;;) {
      const int first = nodes_[static_cast<std::size_t>(at)].first;
      if (first < 0) {
        visit(facets_[static_cast<std::size_t>(-first - 1)]);
      } else {
        const bool left = nodes_[static_cast<std::size_t>(first)].may_hold(x, within_mm);
        const bool right = nodes_[static_cast<std::size_t>(first) + 1].may_hold(x, within_mm);
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

 private:
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
  };

  struct Beam;  // of a facet, while the tree grows
  void grow(const TriangleMesh& mesh, std::vector<Beam>& beams, double reach_mm);
  Node node_around(const TriangleMesh& mesh, const Beam* from, const Beam* to) const;

  std::vector<Facet> facets_;
  std::vector<Node> nodes_;
  double round_mm_ = 0;
};

}  // namespace scattermeter
