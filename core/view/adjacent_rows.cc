#include "core/view/adjacent_rows.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace scattermeter {

std::vector<std::vector<std::int32_t>> adjacent_rows(const std::vector<std::int32_t>& row_of_sample,
                                                     int width, int height, std::size_t n_rows) {
  const auto w = static_cast<std::size_t>(width);
  const auto h = static_cast<std::size_t>(height);
  if (width < 0 || height < 0 || row_of_sample.size() != w * h) {
    throw std::invalid_argument("adjacent_rows: not width x height samples");
  }
  const auto last = std::max_element(row_of_sample.begin(), row_of_sample.end());
  if (last != row_of_sample.end() && *last >= 0 && static_cast<std::size_t>(*last) >= n_rows) {
    throw std::invalid_argument("adjacent_rows: a row is out of range");
  }
  std::vector<std::vector<std::int32_t>> adjacent(n_rows);
  const auto link = [&](std::int32_t a, std::int32_t b) {
    if (a < 0 || b < 0 || a == b) return;
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
      std::vector<std::int32_t>& list = adjacent[static_cast<std::size_t>(from)];
      // Neighbouring samples mostly repeat the pair that came last.
      if (std::find(list.rbegin(), list.rend(), to) == list.rend()) list.push_back(to);
    }
  };
  for (std::size_t y = 0; y < h; ++y) {
    for (std::size_t x = 0; x < w; ++x) {
      const std::size_t i = y * w + x;
      const std::int32_t row = row_of_sample[i];
      if (x + 1 < w) link(row, row_of_sample[i + 1]);
      if (y + 1 == h) continue;
      link(row, row_of_sample[i + w]);
      if (x + 1 < w) link(row, row_of_sample[i + w + 1]);
      if (x > 0) link(row, row_of_sample[i + w - 1]);
    }
  }
  for (std::vector<std::int32_t>& list : adjacent) std::sort(list.begin(), list.end());
  return adjacent;
}

}  // namespace scattermeter
