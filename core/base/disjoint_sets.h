// Disjoint sets that can be joined (union-find).
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace scattermeter {

// Initially every number 0 .. n - 1 is a set of its own. A set is identified by its smallest
// number.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n) : parent_(n), sets_(n) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int set_of(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(int i, int j) {
    const auto [low, high] = std::minmax({set_of(i), set_of(j)});
    if (low == high) return;
    parent(high) = low;
    --sets_;
  }
  std::size_t sets() const { return sets_; }

 private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }

  std::vector<int> parent_;
  std::size_t sets_;
};

}  // namespace scattermeter
