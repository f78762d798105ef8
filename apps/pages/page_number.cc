#include "apps/pages/page_number.h"

#include <string>

#include <fmt/core.h>

namespace scattermeter::apps {

double page_number(double value) { return std::stod(fmt::format("{:.6g}", value)) + 0.0; }

}  // namespace scattermeter::apps
