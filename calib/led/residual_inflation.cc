#include "calib/led/residual_inflation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace scattermeter::calib {

double residual_inflation(double chi2, double n, double parameters) {
  const double dof = n - parameters;
  if (!(dof >= 1.0)) return 1.0;
  const double ratio = chi2 / dof;
  return ratio > 1.0 + 3.0 * std::sqrt(2.0 / dof) ? ratio : 1.0;
}

double cell_inflation(const LedScene& scene, const std::vector<double>& predicted_W_per_mm2_sr,
                      const std::vector<bool>& use, double parameters) {
  double worst = 1.0;
  for (int edge : {1, 3, 6}) {
    std::map<std::tuple<std::size_t, int, int, int>, std::pair<double, double>> blocks;
    for (std::size_t i = 0; i < use.size(); ++i) {
      if (!use[i]) continue;
      const ShadedCell& cell = scene.cells[i];
      auto& [sum, n] = blocks[{cell.shot, cell.channel, cell.column / edge, cell.row / edge}];
      sum += (cell.radiance_W_per_mm2_sr - predicted_W_per_mm2_sr[i]) / cell.std_W_per_mm2_sr;
      n += 1.0;
    }
    double chi2 = 0.0, n = 0.0;
    for (const auto& [key, block] : blocks) {
      chi2 += block.first * block.first / block.second;
      n += 1.0;
    }
    worst = std::max(worst, residual_inflation(chi2, n, std::min(parameters, 0.5 * n)));
  }
  return worst;
}

}  // namespace scattermeter::calib
