// Ray casting against a triangle mesh (Embree).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

struct RayHit {
  int facet_idx = -1;                                     // -1: nothing hit
  Eigen::Vector3d barycentric = Eigen::Vector3d::Zero();  // weights of the facet's vertices
  double distance = 0;  // in units of the direction vector's length
};

// Embree computes in float: the mesh is stored relative to the centre of its bounds, so that an
// object far from the world's origin keeps its digits. All calls are safe from several threads at
// once.
class RayScene {
 public:
  // Precondition: mesh_problem(mesh) is empty. Throws std::runtime_error if Embree cannot be used.
  explicit RayScene(const TriangleMesh& mesh);
  ~RayScene();
  RayScene(const RayScene&) = delete;
  RayScene& operator=(const RayScene&) = delete;

  // First facet that the ray meets; direction of any length.
  RayHit first_hit(const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction) const;

  // The same for many rays from one origin, several at a time in SIMD lanes: fastest for
  // neighbouring rays. Precondition: as many hits as directions. A direction that is not finite
  // hits nothing.
  void first_hits(const Eigen::Vector3d& origin_mm, std::span<const Eigen::Vector3f> directions,
                  std::span<RayHit> hits) const;

  // First facet between two distances along a unit direction, in float throughout: for an origin
  // within the object's bounds or near them.
  RayHit first_hit_between(const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& unit,
                           double near_mm, double far_mm) const;

  // Whether the open segment from a surface point to `target_mm` meets the mesh. The point is moved
  // 1e-5 of the object's size along `normal` first, so that its own facet does not count.
  bool occluded(const Eigen::Vector3d& surface_mm, const Eigen::Vector3d& normal,
                const Eigen::Vector3d& target_mm) const;

  // The same for a target infinitely far away in a direction of any length.
  bool occluded_toward(const Eigen::Vector3d& surface_mm, const Eigen::Vector3d& normal,
                       const Eigen::Vector3d& direction) const;

  // Whether a point lies inside the closed mesh, by the solid angle that the mesh subtends there.
  bool contains(const Eigen::Vector3d& point_mm) const;

  const TriangleMesh& mesh() const { return mesh_; }
  double size_mm() const { return size_mm_; }  // largest extent along an axis
  // In a convex body, no facet that faces a target is occluded from it.
  bool convex() const { return convex_; }

 private:
  struct Embree;
  // A ray with unit direction that starts near the object, relative to its centre, so that float
  // keeps its digits for a distant camera.
  struct Start {
    Eigen::Vector3d at_mm, unit;
    double skip_mm, length;
  };
  Start start_of(const Eigen::Vector3d& origin_mm, const Eigen::Vector3d& direction) const;
  // `start_mm`: relative to the centre, as in occluded_between().
  RayHit hit_between(const Eigen::Vector3d& start_mm, const Eigen::Vector3d& unit, float near_mm,
                     float far_mm) const;
  bool occluded_between(const Eigen::Vector3d& start_mm, const Eigen::Vector3d& unit,
                        double distance_mm) const;
  TriangleMesh mesh_;
  Eigen::Vector3d center_mm_;
  double size_mm_;
  bool convex_;
  std::unique_ptr<Embree> embree_;
};

}  // namespace scattermeter
