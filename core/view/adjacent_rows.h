// Rows that lie side by side in the picture.
#pragma once

#include <cstdint>
#include <vector>

namespace scattermeter {

// For each row those with a sample beside or diagonally beside one of its own, ascending. Across
// creases and silhouettes, where samples are in no row, none are adjacent.
// row_of_sample: width x height, row by row; -1: in no row. Std::invalid_argument for another size
// or a row that is not below n_rows.
std::vector<std::vector<std::int32_t>> adjacent_rows(const std::vector<std::int32_t>& row_of_sample,
                                                     int width, int height, std::size_t n_rows);

}  // namespace scattermeter
