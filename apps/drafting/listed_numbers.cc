#include "apps/drafting/listed_numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

#include "core/base/input_error.h"

namespace scattermeter::apps {

std::vector<double> listed_numbers(std::string_view text, char separator, const char* option,
                                   std::string_view whole) {
  std::vector<double> out;
  while (!text.empty()) {
    const std::size_t length = std::min(text.find(separator), text.size());
    const std::string_view part = text.substr(0, length);
    double value = 0.0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || end != part.data() + part.size() || !std::isfinite(value)) {
      throw InputError(option, fmt::format("\"{}\" is no number, got {}", part, whole));
    }
    out.push_back(value);
    if (length + 1 == text.size())
      throw InputError(option, fmt::format("ends early, got {}", whole));
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return out;
}

}  // namespace scattermeter::apps
