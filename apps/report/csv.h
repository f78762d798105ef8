// Writing of comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// Encodes a field by RFC 4180: quoted if it contains a comma, a quote or a line end, with quotes
// doubled.
std::string csv_field(const std::string& text);

// The shortest decimal that reads back as the same double; empty if the number is not finite.
std::string csv_number(double value);

// A table with a header line. Lines end with a line feed.
class Csv {
 public:
  explicit Csv(const std::vector<std::string>& header);
  // Adds a row of unencoded fields (numbers by csv_number()). Throws std::invalid_argument unless
  // there are as many fields as in the header.
  void add_row(const std::vector<std::string>& fields);
  const std::string& text() const { return text_; }

 private:
  void append(const std::vector<std::string>& fields);
  std::size_t columns_;
  std::string text_;
};

}  // namespace scattermeter::apps
