// Shots cut into parts, and those into cells, to see on what scale a model is off.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/fit/lack_of_fit.h"

namespace scattermeter {

struct ShotPartsOptions {
  int levels = 4;            // at most 2^levels parts a shot, fewer where there are many shots
  double most_parts = 96.0;  // in all, about
  int finer_levels = 2;      // 2^finer_levels cells in a part
  int least_rows = 12;       // in a cell
};

// Rows of some shots, one below the other, by where their patches are.
class ShotParts {
 public:
  ShotParts() = default;
  // All by row; l > 0 in the sum of every cell. shot_rows: rows of each shot.
  // Precondition (std::invalid_argument): lengths agree.
  ShotParts(const std::vector<Eigen::Index>& shot_rows,
            const std::vector<Eigen::Vector3d>& center_mm, const std::vector<double>& area_mm2,
            const Eigen::VectorXd& l, const ShotPartsOptions& options = {});

  Eigen::Index n_cells() const { return cells_.rows(); }
  Eigen::Index n_parts() const { return parts_.rows(); }
  Eigen::Index part_of_row(Eigen::Index row) const {
    return part_of_row_[static_cast<std::size_t>(row)];
  }
  Eigen::Index cell_of_row(Eigen::Index row) const {
    return cell_of_row_[static_cast<std::size_t>(row)];
  }
  // Cells x rows: the light of a cell, relative to its l.
  const Eigen::MatrixXd& cells() const { return cells_; }
  // Parts x cells: relative light of a part from that of its cells.
  const Eigen::MatrixXd& parts() const { return parts_; }
  // Cells x cells: relative light of a cell less that of its part.
  const Eigen::MatrixXd& about_parts() const { return about_parts_; }

 private:
  Eigen::MatrixXd cells_, parts_, about_parts_;
  std::vector<Eigen::Index> part_of_row_, cell_of_row_;
};

}  // namespace scattermeter
