// Tables of aligned columns for the terminal.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// A table whose columns are as wide as their widest cell, counted in code points, and two spaces
// apart. Lines have no trailing spaces.
class TextTable {
 public:
  enum class Align { kLeft, kRight };
  struct Column {
    std::string header;
    Align align = Align::kRight;
  };

  explicit TextTable(std::vector<Column> columns);
  // Throws std::invalid_argument unless there are as many cells as columns.
  void add_row(std::vector<std::string> cells);
  // Header and rows, each terminated by a newline.
  std::string text() const;

 private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace scattermeter::apps
