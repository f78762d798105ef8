// The surface of a body, for paths that run inside it.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/body_planes.h"
#include "core/mesh/clearance_grid.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// A point where a path meets the surface.
struct Crossing {
  double distance_mm = 0;    // along the path
  Eigen::Vector3d point_mm;  // the point, or one some grains away from it (see PathBoundary)
  Eigen::Vector3d normal;    // outwards
  int plane_idx = -1;        // for a convex body of few planes
  int facet_idx = -1;        // otherwise
};

// Positions are double. A convex body of few planes needs no rays: a point is inside if it is
// behind all planes, and rounding at edges results in another crossing of zero length. Any other
// body asks Embree, in float, which facet comes next, and takes the distance from the facet's
// plane. Against rounding, in grains of 2e-6 of the body's size: a ray starts a grain behind its
// origin, so that a float rounded beyond a facet ahead does not miss it, and ignores facets hit
// from the wrong side there; a point on the surface is moved to 16 grains from its facet's edges
// (less on facets not much larger), which keeps it clear of the neighbours. A hit from the wrong
// side farther on means that the path has left the body.
class PathBoundary {
 public:
  enum class Method { kAuto, kRays };  // kRays: even where planes suffice
  static constexpr int kFewPlanes = 32;

  // The scene must outlive the object. Precondition as RayScene's.
  explicit PathBoundary(const RayScene& scene, Method method = Method::kAuto);

  const RayScene& scene() const { return scene_; }
  double size_mm() const { return size_mm_; }
  // The planes exist for every body of few planes; by_planes(): paths use them instead of rays.
  const BodyPlanes& body() const { return body_; }
  bool by_planes() const { return by_planes_; }
  bool convex() const { return convex_; }
  // A lower bound of the distance from a point inside to the surface; exact if by_planes().
  double clearance_mm(const Eigen::Vector3d& x) const {
    return std::max(0.0, grid_ ? grid_->at(x) : body_.least_depth_mm(x));
  }
  const Eigen::Vector3d& facet_normal(int facet) const {
    return normal_[static_cast<std::size_t>(facet)];
  }

  enum class Flight { kInside, kAtSurface, kLost };
  // Flies from x, inside, along the unit direction by `step_mm`, or to the surface, and leaves the
  // remainder in step_mm. `clearance_mm`: before and after, a lower bound of the distance to the
  // surface, so that most steps need no query.
  Flight fly(Eigen::Vector3d& x, const Eigen::Vector3d& direction, double& step_mm,
             double& clearance_mm, Crossing& crossing) const {
    if (step_mm < clearance_mm) {
      x += step_mm * direction;
      clearance_mm -= step_mm;
      step_mm = 0.0;
      return Flight::kInside;
    }
    return by_planes_ ? fly_by_planes(x, direction, step_mm, clearance_mm, crossing)
                      : fly_by_rays(x, direction, step_mm, clearance_mm, crossing);
  }

  // Where light that has left the body at x enters it again. Empty for a convex body.
  std::optional<Crossing> entering(const Eigen::Vector3d& x,
                                   const Eigen::Vector3d& direction) const;

  // Where light from a point outside, not on the surface, meets the body.
  std::optional<Crossing> met(const Eigen::Vector3d& x, const Eigen::Vector3d& direction) const;

  // Whether the straight line between two points inside or on the surface stays inside.
  bool clear_inside(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  // The same, if `to` also lies on a facet of that plane.
  bool reaches_plane(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int plane) const;
  // The facet of a plane that is visible at x from a point outside; -1: x is hidden or on no facet
  // of the plane.
  int facet_seen(const Eigen::Vector3d& from, const Eigen::Vector3d& x, int plane) const;

  // The facet that a crossing at x lies on.
  int facet_at(const Crossing& crossing, const Eigen::Vector3d& x) const {
    return crossing.facet_idx >= 0 ? crossing.facet_idx : facet_of_plane(crossing.plane_idx, x);
  }
  int facet_of_plane(int plane, const Eigen::Vector3d& x) const;
  // The facet of a plane that a point of the plane lies on; -1: on none.
  int facet_holding(int plane, const Eigen::Vector3d& x) const;
  // The plane on which a point of the surface with this normal lies; -1: on none of few.
  int plane_at(const Eigen::Vector3d& x, const Eigen::Vector3d& normal) const;

 private:
  Flight fly_by_planes(Eigen::Vector3d& x, const Eigen::Vector3d& direction, double& step_mm,
                       double& clearance_mm, Crossing& crossing) const;
  Flight fly_by_rays(Eigen::Vector3d& x, const Eigen::Vector3d& direction, double& step_mm,
                     double& clearance_mm, Crossing& crossing) const;
  // Whether two points, the first one inside or on the surface, certainly lie on the same side of
  // every plane, so that the line between them meets no facet; the second may be `beyond_mm` beyond
  // a plane.
  bool in_one_cell(const Eigen::Vector3d& from, const Eigen::Vector3d& to, double beyond_mm) const;
  // Barycentric weights of a point of its plane: per_mm . x + at_origin.
  struct FacetWeights {
    std::array<Eigen::Vector3d, 3> per_mm;
    std::array<double, 3> at_origin;
  };
  struct Nearest {
    int facet = -1;
    double least_weight;  // barycentric, of the point in that facet: negative outside of it
  };
  Nearest nearest_of_plane(int plane, const Eigen::Vector3d& x) const;
  // That a ray finds there.
  int facet_by_ray(int plane, const Eigen::Vector3d& x) const;
  // First facet passed outwards (side 1) or inwards (-1) within a distance. `lost`: another was
  // passed in the opposite direction before.
  std::optional<Crossing> passed(const Eigen::Vector3d& x, const Eigen::Vector3d& direction,
                                 double within_mm, double side, bool& lost) const;
  Eigen::Vector3d off_the_edges(int facet, const Eigen::Vector3d& x) const;

  const RayScene& scene_;
  Box3d box_;
  double size_mm_;
  double grain_mm_;
  BodyPlanes body_;
  bool convex_;
  bool by_planes_;
  std::vector<Eigen::Vector3d> normal_;  // by facet
  std::vector<double> offset_mm_;
  std::vector<FacetWeights> weights_;  // by facet; empty without planes
  std::optional<ClearanceGrid> grid_;
};

}  // namespace scattermeter
