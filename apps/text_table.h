// Aligned columns for a terminal.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// Columns as wide as their widest cell, counted in code points, two spaces apart; lines without
// trailing spaces.
class TextTable {
 public:
  enum class Align { kLeft, kRight };
  struct Column {
    std::string header;
    Align align = Align::kRight;
  };

  explicit TextTable(std::vector<Column> columns);
  // Precondition (std::invalid_argument): as many cells as columns.
  void add_row(std::vector<std::string> cells);
  // Header and rows, each line ended by a newline.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace scattermeter::apps
