// The surface of a body, for paths that run inside it.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/body_planes.h"
#include "core/mesh/clearance_grid.h"
#include "core/mesh/ray_scene.h"

namespace scattermeter {

// A place where a path meets the surface.
struct Crossing {
  double distance_mm = 0;    // along the path
  Eigen::Vector3d point_mm;  // the place, or one some grains away from it (see PathBoundary)
  Eigen::Vector3d normal;    // outwards
  int plane_idx = -1;        // of a body of few planes that is convex
  int facet_idx = -1;        // else
};

// Positions are double. A convex body of few planes is bounded by them and needs no ray: a point is
// inside where it is behind all of them, and rounding at edges ends in another crossing of zero
// length. Any other body asks Embree, in float, which facet comes next, and takes the distance from
// the facet's plane. Against rounding, in grains of 2e-6 of the body's size: a ray starts a grain
// behind its origin, so that a float that lands beyond a facet ahead does not lose it, and goes on
// past facets met from the wrong side there; a place on the surface is moved to 16 grains from its
// facet's edges (less on facets not much larger), where the neighbours are far enough for that. A
// wrong side farther on means that the path has got outside.
class PathBoundary {
 public:
  enum class Method { kAuto, kRays };  // kRays: even where planes would do
  static constexpr int kFewPlanes = 32;

  // The scene must outlive the object. Precondition as RayScene's.
  explicit PathBoundary(const RayScene& scene, Method method = Method::kAuto);

  const RayScene& scene() const { return scene_; }
  double size_mm() const { return size_mm_; }
  // Planes are there for every body of few of them; by_planes(): they bound it.
  const BodyPlanes& body() const { return body_; }
  bool by_planes() const { return by_planes_; }
  bool convex() const { return convex_; }
  // A lower bound of the distance from a point inside to the surface; 0 for a body by planes.
  double clearance_mm(const Eigen::Vector3d& x) const {
    return grid_ ? std::max(0.0, grid_->at(x)) : 0.0;
  }
  const Eigen::Vector3d& facet_normal(int facet) const {
    return normal_[static_cast<std::size_t>(facet)];
  }

  enum class Flight { kInside, kAtSurface, kLost };
  // Flies from x, inside, along the unit direction by `step_mm`, or to the surface, and leaves in
  // step_mm what is left of it. `clearance_mm`: before and after, a lower bound of the distance to
  // the surface, so that most steps ask for nothing.
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

  // Whether the straight line between two points inside or on the surface stays inside.
  bool clear_inside(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  // The same, and `to` lies on a facet of that plane.
  bool reaches_plane(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int plane) const;
  // The facet of a plane that a point outside sees at x; -1: it sees something else there.
  int facet_seen(const Eigen::Vector3d& from, const Eigen::Vector3d& x, int plane) const;

  // The facet that a crossing at x lies on.
  int facet_at(const Crossing& crossing, const Eigen::Vector3d& x) const {
    return crossing.facet_idx >= 0 ? crossing.facet_idx : facet_of_plane(crossing.plane_idx, x);
  }
  int facet_of_plane(int plane, const Eigen::Vector3d& x) const;

 private:
  Flight fly_by_planes(Eigen::Vector3d& x, const Eigen::Vector3d& direction, double& step_mm,
                       double& clearance_mm, Crossing& crossing) const;
  Flight fly_by_rays(Eigen::Vector3d& x, const Eigen::Vector3d& direction, double& step_mm,
                     double& clearance_mm, Crossing& crossing) const;
  // First facet passed outwards (side 1) or inwards (-1) within a distance. `lost`: one was passed
  // the other way before.
  std::optional<Crossing> passed(const Eigen::Vector3d& x, const Eigen::Vector3d& direction,
                                 double within_mm, double side, bool& lost) const;
  Eigen::Vector3d off_the_edges(int facet, const Eigen::Vector3d& x) const;

  const RayScene& scene_;
  double size_mm_;
  double grain_mm_;
  BodyPlanes body_;
  bool convex_;
  bool by_planes_;
  std::vector<Eigen::Vector3d> normal_;  // by facet
  std::vector<double> offset_mm_;
  std::optional<ClearanceGrid> grid_;
};

}  // namespace scattermeter
