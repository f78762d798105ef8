// The scale of which nothing is known.
#pragma once

#include <limits>

namespace scattermeter::test_support {

inline constexpr double kFree = std::numeric_limits<double>::infinity();  // its relative_std

}  // namespace scattermeter::test_support
