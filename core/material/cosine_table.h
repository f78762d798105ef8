// A function of a cosine, from a table.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace scattermeter {

// Linear between values at equal steps over 0 .. 1; constant beyond.
class CosineTable {
 public:
  static constexpr int kSteps = 64;

  template <class Function>
  explicit CosineTable(const Function& function) {
    for (int k = 0; k <= kSteps; ++k) value_.push_back(function(cosine(k)));
  }
  // The k-th of the cosines, 0 <= k <= kSteps.
  static double cosine(int k) { return static_cast<double>(k) / kSteps; }

  double operator()(double cosine) const {
    const double at = std::clamp(cosine, 0.0, 1.0) * kSteps;
    const auto k = static_cast<std::size_t>(std::min(kSteps - 1, static_cast<int>(at)));
    return value_[k] + (at - static_cast<double>(k)) * (value_[k + 1] - value_[k]);
  }

 private:
  std::vector<double> value_;
};

}  // namespace scattermeter
