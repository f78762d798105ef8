// What varies slowly over the surface, from some rows to all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace scattermeter {

struct RowInterpolation {
  std::vector<std::size_t> rows;  // ascending; of rows that are adjacent to each other, one
  // Values of all rows from those of `rows`. A row in `rows` keeps its own; each other has the
  // value of a plane through those about two rows away, nearer ones weighing more, or, of a strip
  // of rows that no plane fits, their mean. Exact for values that are linear in the position on a
  // facet.
  Eigen::SparseMatrix<double, Eigen::RowMajor> from_rows;
};

// adjacent: of each row (core/view/adjacent_rows.h); empty: all rows stand for themselves.
// normals: unit, of the rows' patches. Throws std::invalid_argument where the sizes differ.
RowInterpolation interpolation_of_rows(const std::vector<Eigen::Vector3d>& centers_mm,
                                       const std::vector<Eigen::Vector3d>& normals,
                                       const std::vector<std::vector<std::int32_t>>& adjacent);

}  // namespace scattermeter
