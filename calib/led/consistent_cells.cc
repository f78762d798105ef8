#include "calib/led/consistent_cells.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "core/base/median.h"

namespace scattermeter::calib {

std::vector<bool> consistent_cells(const LedScene& scene, const std::vector<bool>& lit,
                                   const std::vector<double>& predicted_W_per_mm2_sr,
                                   double outlier_stds) {
  std::vector<double> residuals(scene.cells.size(), 0.0);
  std::vector<double> magnitudes, noises;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!lit[i]) continue;
    const ShadedCell& cell = scene.cells[i];
    const double predicted = predicted_W_per_mm2_sr[i];
    residuals[i] = predicted > 0.0 ? cell.radiance_W_per_mm2_sr / predicted - 1.0 : 1e3;
    magnitudes.push_back(std::abs(residuals[i]));
    noises.push_back(predicted > 0.0 ? cell.std_W_per_mm2_sr / predicted : 1e3);
  }
  const double bulk = kStdPerMad * upper_median(magnitudes);
  const double excess = std::max(1.0, bulk / upper_median(noises));
  std::set<std::tuple<std::size_t, int, int>> out;
  for (std::size_t i = 0; i < residuals.size(); ++i) {
    if (!lit[i]) continue;
    const ShadedCell& cell = scene.cells[i];
    const double limit =
        outlier_stds * excess * cell.std_W_per_mm2_sr / std::max(1e-300, predicted_W_per_mm2_sr[i]);
    if (std::abs(residuals[i]) <= limit) continue;
    const int reach = std::abs(residuals[i]) > 4.0 * limit ? 1 : 0;
    for (int dy = -reach; dy <= reach; ++dy) {
      for (int dx = -reach; dx <= reach; ++dx) {
        out.insert({cell.shot, cell.column + dx, cell.row + dy});
      }
    }
  }
  std::vector<bool> use(residuals.size());
  for (std::size_t i = 0; i < use.size(); ++i) {
    const ShadedCell& cell = scene.cells[i];
    use[i] = lit[i] && !out.contains({cell.shot, cell.column, cell.row});
  }
  return use;
}

}  // namespace scattermeter::calib
