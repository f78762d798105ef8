#include "capture/raw/curve_levels.h"

#include <algorithm>

namespace scattermeter::capture {
namespace {

constexpr std::size_t kValues = 65536;

std::vector<std::uint16_t> distinct_sorted(std::span<const std::uint16_t> values) {
  std::vector<std::uint16_t> levels(values.begin(), values.end());
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

bool explains(const std::vector<std::uint16_t>& levels, const std::vector<std::uint16_t>& samples) {
  std::vector<std::uint8_t> possible(kValues, 0);
  for (const std::uint16_t level : levels) possible[level] = 1;
  return std::all_of(samples.begin(), samples.end(),
                     [&](std::uint16_t sample) { return possible[sample] != 0; });
}

}  // namespace

std::vector<std::uint16_t> curve_levels(std::span<const std::uint16_t> table, int bits,
                                        const std::vector<std::uint16_t>& samples) {
  const std::size_t codes = std::min(table.size(), std::size_t{1} << std::clamp(bits, 1, 16));
  std::size_t end = codes;
  while (end > 0 && table[end - 1] == end - 1) --end;
  if (end == 0) return {};
  std::vector<std::uint16_t> levels = distinct_sorted(table.first(end));
  if (explains(levels, samples)) return levels;
  // The identity tail may have been part of the curve after all.
  levels = distinct_sorted(table.first(codes));
  if (explains(levels, samples)) return levels;
  return {};
}

}  // namespace scattermeter::capture
