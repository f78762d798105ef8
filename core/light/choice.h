// Random choices for sources of light.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/base/random_stream.h"

namespace scattermeter {

// Draws an index in proportion to weights.
class Choice {
 public:
  explicit Choice(const std::vector<double>& weights) {
    double sum = 0.0;
    for (double w : weights) cumulated_.push_back(sum += w);
  }
  double sum() const { return cumulated_.empty() ? 0.0 : cumulated_.back(); }
  std::size_t at(double share) const {
    const auto it = std::upper_bound(cumulated_.begin(), cumulated_.end(), share * sum());
    return std::min(static_cast<std::size_t>(it - cumulated_.begin()), cumulated_.size() - 1);
  }
  double probability(std::size_t i) const {
    return (cumulated_[i] - (i == 0 ? 0.0 : cumulated_[i - 1])) / sum();
  }

 private:
  std::vector<double> cumulated_;
};

// A point of a triangle, all equally likely.
inline Eigen::Vector3d even_point(const std::array<Eigen::Vector3d, 3>& t, RandomStream& random) {
  const double root = std::sqrt(random.uniform());
  const double v = random.uniform();
  return t[0] + root * ((1.0 - v) * (t[1] - t[0]) + v * (t[2] - t[0]));
}

}  // namespace scattermeter
