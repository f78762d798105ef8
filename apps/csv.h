// Comma-separated values.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// A field as it stands in a file: in quotes where it holds a comma, a quote or a line end, quotes
// doubled (RFC 4180).
std::string csv_field(const std::string& text);

// The shortest decimal that reads back as the same double; empty for a number that is not finite.
std::string csv_number(double value);

// A table with a header line. Lines end with a line feed alone.
class Csv {
 public:
  explicit Csv(const std::vector<std::string>& header);
  // Precondition (std::invalid_argument): as many fields as the header has. Fields are quoted here;
  // numbers come through csv_number().
  void add_row(const std::vector<std::string>& fields);
  const std::string& text() const { return text_; }

 private:
  void append(const std::vector<std::string>& fields);
  std::size_t columns_;
  std::string text_;
};

}  // namespace scattermeter::apps
