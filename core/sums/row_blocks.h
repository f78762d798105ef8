// Blocks of neighbouring rows, as many as fit into the lanes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/sums/dipole_kernels.h"

namespace scattermeter {

// Can be reused for many sums over the same rows. Built in parallel; the same blocks for any number
// of threads.
class RowBlocks {
 public:
  struct Block {
    RowLanes lanes;  // those beyond `count` repeat the first
    Eigen::Vector3d center_mm;
    double radius_mm;          // largest distance of a row from the centre
    std::size_t first, count;  // rows order()[first, first + count)
  };

  // Domain: finite (std::invalid_argument naming the row).
  explicit RowBlocks(std::span<const Eigen::Vector3d> rows_mm);

  std::size_t size() const { return order_.size(); }
  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<std::uint32_t>& order() const { return order_; }

 private:
  void split(std::span<const Eigen::Vector3d> rows_mm, std::size_t first, std::size_t last);
  std::vector<std::uint32_t> order_;
  std::vector<Block> blocks_;
};

}  // namespace scattermeter
