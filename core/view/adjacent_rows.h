// Rows that are adjacent in the picture.
#pragma once

#include <cstdint>
#include <vector>

namespace scattermeter {

// For each row, those with a sample horizontally, vertically or diagonally next to one of its own,
// ascending. Rows are not adjacent across creases and silhouettes, where samples belong to no row.
// row_of_sample: width x height, row by row; -1: in no row. Throws std::invalid_argument for
// another size or for a row that is not below n_rows.
std::vector<std::vector<std::int32_t>> adjacent_rows(const std::vector<std::int32_t>& row_of_sample,
                                                     int width, int height, std::size_t n_rows);

}  // namespace scattermeter
