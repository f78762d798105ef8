#include "core/fit/shot_parts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/position_cells.h"

namespace scattermeter {

ShotParts::ShotParts(const std::vector<Eigen::Index>& shot_rows,
                     const std::vector<Eigen::Vector3d>& center_mm,
                     const std::vector<double>& area_mm2, const Eigen::VectorXd& l,
                     const ShotPartsOptions& options) {
  Eigen::Index rows = 0;
  for (const Eigen::Index n : shot_rows) rows += n;
  if (rows != l.size() || center_mm.size() != area_mm2.size() ||
      static_cast<Eigen::Index>(area_mm2.size()) != rows) {
    throw std::invalid_argument("ShotParts: lengths differ");
  }
  const double of_each = options.most_parts / static_cast<double>(shot_rows.size());
  const int levels = std::clamp(static_cast<int>(std::log2(of_each)), 1, options.levels);
  std::vector<Eigen::Index> part_of_cell;
  Eigen::Index first = 0, n_parts = 0, n_cells = 0;
  for (const Eigen::Index n : shot_rows) {
    const auto begin = center_mm.begin() + first;
    const std::vector<Eigen::Vector3d> centers(begin, begin + n);
    // Cells lie in the parts: the cuts are the same.
    const std::vector<int> part = position_cells(centers, levels, options.least_rows);
    const std::vector<int> cell =
        position_cells(centers, levels + options.finer_levels, options.least_rows);
    Eigen::Index next_part = n_parts, next_cell = n_cells;
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto k = static_cast<std::size_t>(j);
      part_of_row_.push_back(n_parts + part[k]);
      cell_of_row_.push_back(n_cells + cell[k]);
      next_part = std::max(next_part, part_of_row_.back() + 1);
      next_cell = std::max(next_cell, cell_of_row_.back() + 1);
      part_of_cell.resize(static_cast<std::size_t>(next_cell));
      part_of_cell[static_cast<std::size_t>(cell_of_row_.back())] = part_of_row_.back();
    }
    n_parts = next_part;
    n_cells = next_cell;
    first += n;
  }
  Eigen::VectorXd light = Eigen::VectorXd::Zero(n_cells);
  for (Eigen::Index j = 0; j < rows; ++j) {
    light[cell_of_row(j)] += area_mm2[static_cast<std::size_t>(j)] * l[j];
  }
  light_ = Eigen::VectorXd::Zero(n_parts);
  std::vector<Eigen::Triplet<double>> in_part, in_cell;
  for (Eigen::Index c = 0; c < n_cells; ++c) {
    const Eigen::Index part = part_of_cell[static_cast<std::size_t>(c)];
    in_part.emplace_back(part, c, light[c]);
    light_[part] += light[c];
  }
  for (Eigen::Index j = 0; j < rows; ++j) {
    const Eigen::Index c = cell_of_row(j);
    in_cell.emplace_back(c, j, area_mm2[static_cast<std::size_t>(j)] / light[c]);
  }
  cells_ = Sums(n_cells, rows);
  cells_.setFromTriplets(in_cell.begin(), in_cell.end());
  parts_ = Sums(n_parts, n_cells);
  parts_.setFromTriplets(in_part.begin(), in_part.end());
  Sums holds = parts_;  // 0 or 1
  holds.coeffs().setOnes();
  parts_ = light_.cwiseInverse().asDiagonal() * parts_;
  about_parts_ = Sums(n_cells, n_cells);
  about_parts_.setIdentity();
  about_parts_ -= Sums(Sums(holds.transpose()) * parts_);
}

Eigen::VectorXd ShotParts::levelled(const Eigen::VectorXd& light,
                                    const Eigen::VectorXd& rows) const {
  const Eigen::VectorXd ratio = of_parts(rows).cwiseQuotient(of_parts(light));
  return light.cwiseProduct(ratio(part_of_row_));
}

}  // namespace scattermeter
