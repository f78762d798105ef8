// A grid of lower bounds of the distance to the surface.
#pragma once

#include <cmath>
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
    const int i = static_cast<int>(std::floor(u.x()));
    const int j = static_cast<int>(std::floor(u.y()));
    const int k = static_cast<int>(std::floor(u.z()));
    if (i < 0 || j < 0 || k < 0 || i >= n_[0] || j >= n_[1] || k >= n_[2]) return -1.0;
    return bound_mm_[index(i, j, k)];
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
  std::vector<float> bound_mm_;
};

}  // namespace scattermeter
