// Errors common to groups of rows.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace scattermeter {

// of_row * root: rows x columns of unit deviation; the errors of the groups are root times
// independent unit errors, and those of the rows follow from their group's. Both empty: none.
struct CorrelatedErrors {
  Eigen::SparseMatrix<double, Eigen::RowMajor> of_row = {};  // rows x groups
  Eigen::MatrixXd root = {};                                 // groups x columns
};

}  // namespace scattermeter
