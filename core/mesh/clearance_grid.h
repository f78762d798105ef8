// A grid of lower bounds of the distance to the surface.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/mesh/triangle_mesh.h"

namespace scattermeter {

// Cubic cells over a mesh, each with a lower bound of the distance from any of its points to the
// surface: the distance to the nearest cell that a facet may touch, between the cells' borders
// (Euclidean distance transform). The bound falls short by at most three diagonals of a cell.
class ClearanceGrid {
 public:
  // cells: number along the longest side of the mesh, >= 1.
  explicit ClearanceGrid(const TriangleMesh& mesh, int cells = 96);

  // The bound at a point; negative outside the grid, which extends one cell beyond the mesh's
  // bounds.
  double at(const Eigen::Vector3d& x) const {
    const Eigen::Vector3d u = (x - origin_mm_) * cells_per_mm_;
    if (!(u.x() >= 0.0 && u.y() >= 0.0 && u.z() >= 0.0)) return -1.0;
    const int i = static_cast<int>(u.x());
    const int j = static_cast<int>(u.y());
    const int k = static_cast<int>(u.z());
    if (i >= n_[0] || j >= n_[1] || k >= n_[2]) return -1.0;
    return steps_[index(i, j, k)] * step_mm_;
  }

 private:
  std::size_t index(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(n_[1]) +
            static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(n_[0]) +
           static_cast<std::size_t>(i);
  }
  void mark(const TriangleMesh& mesh, int facet, std::vector<float>& squared) const;

  Eigen::Vector3d origin_mm_;
  double cell_mm_;
  double cells_per_mm_;
  Eigen::Vector3i n_;
  double step_mm_;                   // of bounds
  std::vector<std::uint8_t> steps_;  // down to the bound's; a byte each, as paths read at random
};

}  // namespace scattermeter
