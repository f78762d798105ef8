#include "calib/led/led_ambient.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "core/base/chi_square.h"
#include "core/base/median.h"

namespace scattermeter::calib {
namespace {

constexpr double kAmbientDoubt = 1e-6;

double squared_misfit(const ShadedCell& cell, double residual) {
  const double predicted = cell.radiance_W_per_mm2_sr / (1.0 + residual);
  return std::pow((cell.radiance_W_per_mm2_sr - predicted) / cell.std_W_per_mm2_sr, 2);
}

}  // namespace

bool ambient_is_seen(const LedScene& scene, const LedFit& without, const LedFit& with) {
  const std::size_t n = scene.cells.size();
  if (without.cell_residuals.size() != n || with.cell_residuals.size() != n) return false;
  double fall = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!without.cell_used[i] || !with.cell_used[i]) continue;
    const double change = squared_misfit(scene.cells[i], without.cell_residuals[i]) -
                          squared_misfit(scene.cells[i], with.cell_residuals[i]);
    if (std::isfinite(change)) fall += change;
  }
  double constants = 0.0;
  for (const FittedAmbient& a : with.ambient) {
    constants += static_cast<double>(a.relative.isFinite().count());
  }
  if (!(fall > 0.0) || constants == 0.0) return false;
  return chi_square_tail(fall / with.plane_inflation, constants) < kAmbientDoubt;
}

std::vector<FittedAmbient> fitted_ambient(const LedScene& scene, const LedSolve& what,
                                          const LedSolution& solution,
                                          const Eigen::MatrixXd& covariance) {
  constexpr double kNoLight = std::numeric_limits<double>::quiet_NaN();
  std::map<std::pair<std::size_t, int>, std::vector<double>> own;
  for (std::size_t i = 0; i < what.use_cell.size(); ++i) {
    const ShadedCell& cell = scene.cells[i];
    if (!what.use_cell[i]) continue;
    own[{cell.shot, cell.channel}].push_back(solution.cell_radiance[i] -
                                             solution.ambient[cell.shot][cell.channel]);
  }
  std::vector<FittedAmbient> out;
  for (std::size_t s = 0; s < what.free_ambient.size(); ++s) {
    if (!what.free_ambient[s]) continue;
    FittedAmbient found{s, solution.ambient[s], Eigen::Array3d::Constant(kNoLight),
                        Eigen::Array3d::Constant(kNoLight)};
    for (int c = 0; c < 3; ++c) {
      const auto cells = own.find({s, c});
      if (cells == own.end()) continue;
      const double led = upper_median(cells->second);
      const Eigen::Index at = solution.ambient_at + 3 * static_cast<Eigen::Index>(s) + c;
      found.relative[c] = solution.ambient[s][c] / led;
      found.relative_std[c] = std::sqrt(covariance(at, at)) * solution.ambient_unit[s][c] / led;
    }
    out.push_back(found);
  }
  return out;
}

PlaneCells without_ambient(const PlaneCells& lit, const PlaneCells& ambient) {
  std::map<std::array<int, 3>, const ShadedCell*> dark;
  for (const ShadedCell& cell : ambient.cells) {
    dark[{cell.column, cell.row, cell.channel}] = &cell;
  }
  // From the index of a cell in the grid of `lit` to that of the cell of `ambient` at its centre.
  const auto index = [](int at, int of, int on) { return (2 * at + 1) * on / (2 * of); };
  PlaneCells out = lit;
  out.cells.clear();
  for (ShadedCell cell : lit.cells) {
    const auto found = dark.find({index(cell.column, lit.columns, ambient.columns),
                                  index(cell.row, lit.rows, ambient.rows), cell.channel});
    if (found == dark.end()) continue;
    cell.radiance_W_per_mm2_sr -= found->second->radiance_W_per_mm2_sr;
    cell.std_W_per_mm2_sr = std::hypot(cell.std_W_per_mm2_sr, found->second->std_W_per_mm2_sr);
    out.cells.push_back(cell);
  }
  return out;
}

}  // namespace scattermeter::calib
