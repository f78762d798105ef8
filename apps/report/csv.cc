#include "apps/report/csv.h"

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace scattermeter::apps {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string csv_number(double value) {
  if (!std::isfinite(value)) return "";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return {text.data(), end};
}

Csv::Csv(const std::vector<std::string>& header) : columns_(header.size()) { append(header); }

void Csv::add_row(const std::vector<std::string>& fields) {
  if (fields.size() != columns_) {
    throw std::invalid_argument("Csv: " + std::to_string(fields.size()) + " fields for " +
                                std::to_string(columns_) + " columns");
  }
  append(fields);
}

void Csv::append(const std::vector<std::string>& fields) {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (i > 0) text_ += ',';
    text_ += csv_field(fields[i]);
  }
  text_ += '\n';
}

}  // namespace scattermeter::apps
