#include "core/sums/row_blocks.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include <oneapi/tbb/parallel_invoke.h>

namespace scattermeter {

RowBlocks::RowBlocks(std::span<const Eigen::Vector3d> rows_mm) : order_(rows_mm.size()) {
  for (std::size_t i = 0; i < rows_mm.size(); ++i) {
    if (rows_mm[i].allFinite()) continue;
    std::ostringstream text;
    text << "RowBlocks: row " << i << " at " << rows_mm[i].transpose() << " mm";
    throw std::invalid_argument(text.str());
  }
  std::iota(order_.begin(), order_.end(), 0U);
  blocks_.resize((rows_mm.size() + kRowLanes - 1) / kRowLanes);
  if (!order_.empty()) split(rows_mm, 0, order_.size());
}

void RowBlocks::split(std::span<const Eigen::Vector3d> rows_mm, std::size_t first,
                      std::size_t last) {
  const auto row = [&](std::size_t i) -> const Eigen::Vector3d& { return rows_mm[order_[i]]; };
  Eigen::Vector3d low = row(first), high = low;
  for (std::size_t i = first; i < last; ++i) {
    low = low.cwiseMin(row(i));
    high = high.cwiseMax(row(i));
  }
  if (last - first > kRowLanes) {
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    // Full blocks on the left.
    const std::size_t blocks = (last - first + kRowLanes - 1) / kRowLanes;
    const std::size_t middle = first + (blocks + 1) / 2 * kRowLanes;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last), [&](std::uint32_t a, std::uint32_t b) {
      const double xa = rows_mm[a][axis], xb = rows_mm[b][axis];
      return xa != xb ? xa < xb : a < b;
    });
    constexpr std::size_t kLarge = 4096;
    if (last - first > kLarge) {
      oneapi::tbb::parallel_invoke([&] { split(rows_mm, first, middle); },
                                   [&] { split(rows_mm, middle, last); });
    } else {
      split(rows_mm, first, middle);
      split(rows_mm, middle, last);
    }
    return;
  }
  // All before are full.
  Block& block = blocks_[first / kRowLanes];
  block = {{}, 0.5 * (low + high), 0.0, first, last - first};
  for (std::size_t i = 0; i < kRowLanes; ++i) {
    const Eigen::Vector3d& p = row(i < block.count ? first + i : first);
    block.lanes.x[i] = p.x();
    block.lanes.y[i] = p.y();
    block.lanes.z[i] = p.z();
    block.radius_mm = std::max(block.radius_mm, (p - block.center_mm).norm());
  }
}

}  // namespace scattermeter
