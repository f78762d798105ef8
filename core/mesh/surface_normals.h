// Normals of the surface that a mesh stands for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// Facets that meet at less than kCrease_rad (core/mesh/creases.h) and whose edges are no farther
// than this from a curve through them (an eighth of their width times that angle) stand for a
// smooth surface: half of what the position of a careful user's piece is known to. Facets of a
// wedge or of a coarse body do not.
inline constexpr double kMostSagitta_mm = 0.05;
// Nor do facets of which one is more than this many times as wide as the other: a face, and a part
// of the round edge beside it.
inline constexpr double kMostWidthRatio = 4.0;

// Facets that stand for a smooth surface have a normal that is interpolated between their corners;
// a corner has the mean of the normals of the facets there that are one smooth surface with this
// one, weighted so that it is exact on a sphere (N. Max, Weights for computing vertex normals from
// facet normals, Journal of Graphics Tools 4, 1999). All others are flat.
class SurfaceNormals {
 public:
  // Precondition: mesh_problem(mesh) is empty.
  explicit SurfaceNormals(const TriangleMesh& mesh);

  const Eigen::Vector3d& of_facet(int facet) const {
    return of_facet_[static_cast<std::size_t>(facet)];
  }
  // Unit normal of the smooth surface at a point of the facet, world.
  Eigen::Vector3d at(int facet, const Eigen::Vector3d& point_mm) const;
  // Change of the unit normal by a shift along the facet, 1/mm: zero if it is flat; on a sphere of
  // radius r: shift / r.
  Eigen::Matrix3d change_per_mm(int facet) const;
  bool any_curved() const { return !curved_.empty(); }

 private:
  struct Curved {
    Eigen::Vector3d corner_mm, normal_there;
    Eigen::Matrix3d change_per_mm;
  };
  const Curved* curved(int facet) const {
    const std::int32_t i = curved_idx_[static_cast<std::size_t>(facet)];
    return i < 0 ? nullptr : &curved_[static_cast<std::size_t>(i)];
  }

  std::vector<Eigen::Vector3d> of_facet_;
  std::vector<Curved> curved_;
  std::vector<std::int32_t> curved_idx_;  // by facet, -1: flat
};

}  // namespace scattermeter
