#include "apps/pages/page_number.h"

#include <cstdlib>

#include <fmt/core.h>

namespace scattermeter::apps {

// std::stod() throws for subnormal numbers, which the light far from a source may be.
double page_number(double value) {
  return std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr) + 0.0;
}

}  // namespace scattermeter::apps
