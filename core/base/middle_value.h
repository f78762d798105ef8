// The middle one of some values.
#pragma once

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace scattermeter {

// The median; of an even number, the upper one of the two in the middle. std::invalid_argument of
// none.
template <typename T>
T middle_value(std::vector<T> values) {
  if (values.empty()) throw std::invalid_argument("middle_value: no values");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace scattermeter
