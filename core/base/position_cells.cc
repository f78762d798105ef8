#include "core/base/position_cells.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>

namespace scattermeter {
namespace {

using Rows = std::vector<std::size_t>;

void cut(const std::vector<Eigen::Vector3d>& centers_mm, Rows rows, int levels, int least,
         int& next, std::vector<int>& cell) {
  if (levels == 0 || static_cast<int>(rows.size()) < 2 * least) {
    for (const std::size_t row : rows) cell[row] = next;
    ++next;
    return;
  }
  Eigen::Vector3d low = centers_mm[rows.front()];
  Eigen::Vector3d high = low;
  for (const std::size_t row : rows) {
    low = low.cwiseMin(centers_mm[row]);
    high = high.cwiseMax(centers_mm[row]);
  }
  Eigen::Index axis = 0;
  (high - low).maxCoeff(&axis);
  const auto middle = rows.begin() + static_cast<std::ptrdiff_t>(rows.size() / 2);
  std::nth_element(rows.begin(), middle, rows.end(), [&](std::size_t a, std::size_t b) {
    const double x = centers_mm[a][axis], y = centers_mm[b][axis];
    return x < y || (x == y && a < b);
  });
  cut(centers_mm, Rows(rows.begin(), middle), levels - 1, least, next, cell);
  cut(centers_mm, Rows(middle, rows.end()), levels - 1, least, next, cell);
}

}  // namespace

std::vector<int> position_cells(const std::vector<Eigen::Vector3d>& centers_mm, int levels,
                                int least) {
  if (levels < 0 || least < 1) throw std::invalid_argument("position_cells: levels or least");
  std::vector<int> cell(centers_mm.size(), 0);
  if (centers_mm.empty()) return cell;
  Rows rows(centers_mm.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  int next = 0;
  cut(centers_mm, rows, levels, least, next, cell);
  return cell;
}

CellSquares squares_of_sums(const std::vector<int>& cell, const Eigen::VectorXd& values) {
  if (cell.empty()) return {};
  const Eigen::Index n = *std::max_element(cell.begin(), cell.end()) + 1;
  Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(n), count = sum;
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    const int at = cell[static_cast<std::size_t>(j)];
    sum[at] += values[j];
    count[at] += 1.0;
  }
  return {(sum.square() / count.max(1.0)).sum(), static_cast<double>((count > 0.0).count())};
}

}  // namespace scattermeter
