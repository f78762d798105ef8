// The median and the median absolute deviation: location and scatter robust against outliers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace scattermeter {

// The median; for an even number of values, the upper of the two middle ones. std::invalid_argument
// if there are no values.
template <typename T>
T upper_median(std::vector<T> values) {
  if (values.empty()) throw std::invalid_argument("upper_median: no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// The upper median of |value - center|.
template <typename T>
T median_absolute_deviation(std::vector<T> values, T center) {
  for (T& v : values) v = std::abs(v - center);
  return upper_median(std::move(values));
}

// Standard deviation of normally distributed values over their median absolute deviation: the
// inverse of the normal distribution's 75 % quantile, 0.67449.
inline constexpr double kStdPerMad = 1.4826;

}  // namespace scattermeter
