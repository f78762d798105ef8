// Division of positions into cells that hold about equally many.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// Cuts at the median of the widest of x, y, z, as long as each cell keeps `least` positions, at
// most `levels` times. Returns the number of each position's cell, from 0. Domain: levels >= 0,
// least >= 1 (std::invalid_argument).
std::vector<int> position_cells(const std::vector<Eigen::Vector3d>& centers_mm, int levels,
                                int least);

// Of values in cells: the squares of each cell's sum over its number of values, added up, and the
// number of cells that hold any. Where values are independent and of unit variance, as many squares
// as cells are expected.
struct CellSquares {
  double squares = 0;
  double cells = 0;
};
CellSquares squares_of_sums(const std::vector<int>& cell, const Eigen::VectorXd& values);

}  // namespace scattermeter
