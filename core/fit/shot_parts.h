// Shots divided into parts, and parts into cells, to find the scale on which a model is wrong.
#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/fit/lack_of_fit.h"

namespace scattermeter {

struct ShotPartsOptions {
  int levels = 4;            // at most 2^levels parts a shot, fewer where there are many shots
  double most_parts = 96.0;  // in all, about
  int finer_levels = 2;      // 2^finer_levels cells in a part
  int least_rows = 12;       // in a cell
};

// The rows of some shots, one below the other, grouped by the positions of their patches.
class ShotParts {
 public:
  ShotParts() = default;
  // All by row; the sum of l must be > 0 in every cell. shot_rows: number of rows of each shot.
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
  using Sums = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  // Cells x rows: from the light of the rows to that of a cell, relative to its l.
  const Sums& cells() const { return cells_; }
  // Parts x cells: from the relative light of the cells to that of a part.
  const Sums& parts() const { return parts_; }
  // Cells x cells: relative light of a cell minus that of its part.
  const Sums& about_parts() const { return about_parts_; }
  // From the light of the rows to that of the parts, relative to their l.
  Eigen::VectorXd of_parts(const Eigen::VectorXd& rows) const { return parts_ * (cells_ * rows); }
  // Of every part, l times area.
  const Eigen::VectorXd& light() const { return light_; }
  // By row: `light`, scaled in every part to the sum of `rows` there. Precondition: no part of
  // `light` is dark.
  Eigen::VectorXd levelled(const Eigen::VectorXd& light, const Eigen::VectorXd& rows) const;

 private:
  Eigen::VectorXd light_;
  Sums cells_, parts_, about_parts_;
  std::vector<Eigen::Index> part_of_row_, cell_of_row_;
};

}  // namespace scattermeter
