#include "calib/led/plane_map.h"

#include <cmath>
#include <cstddef>
#include <limits>

namespace scattermeter::calib {

LedPlaneMap plane_map(const LedPlaneGrid& grid, const std::vector<ShadedCell>& cells,
                      const std::vector<double>& relative) {
  LedPlaneMap map{grid.file, grid.columns, grid.rows, {}, {}};
  const auto size = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
  std::vector<double> total(size, 0.0), variance(size, 0.0), count(size, 0.0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ShadedCell& cell = cells[i];
    if (cell.shot != grid.shot || !std::isfinite(relative[i])) continue;
    const double percent = 100.0 * relative[i];
    const auto at = static_cast<std::size_t>(cell.row) * static_cast<std::size_t>(grid.columns) +
                    static_cast<std::size_t>(cell.column);
    total[at] += percent;
    variance[at] += std::pow(
        100.0 * cell.std_W_per_mm2_sr / cell.radiance_W_per_mm2_sr * (1.0 + percent / 100.0), 2);
    count[at] += 1.0;
  }
  constexpr double kNoCell = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < size; ++i) {
    map.percent.push_back(count[i] > 0.0 ? total[i] / count[i] : kNoCell);
    map.std_percent.push_back(count[i] > 0.0 ? std::sqrt(variance[i]) / count[i] : kNoCell);
  }
  return map;
}

}  // namespace scattermeter::calib
