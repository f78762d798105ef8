#include "calib/led/led_ambient.h"

#include <array>
#include <cmath>
#include <map>

#include "core/base/chi_square.h"

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

PlaneCells without_ambient(const PlaneCells& lit, const PlaneCells& ambient) {
  std::map<std::array<int, 3>, const ShadedCell*> dark;
  for (const ShadedCell& cell : ambient.cells) {
    dark[{cell.column, cell.row, cell.channel}] = &cell;
  }
  // Of the cell's middle, from the grid of `lit` to that of `ambient`.
  const auto place = [](int at, int of, int on) { return (2 * at + 1) * on / (2 * of); };
  PlaneCells out = lit;
  out.cells.clear();
  for (ShadedCell cell : lit.cells) {
    const auto found = dark.find({place(cell.column, lit.columns, ambient.columns),
                                  place(cell.row, lit.rows, ambient.rows), cell.channel});
    if (found == dark.end()) continue;
    cell.radiance_W_per_mm2_sr -= found->second->radiance_W_per_mm2_sr;
    cell.std_W_per_mm2_sr = std::hypot(cell.std_W_per_mm2_sr, found->second->std_W_per_mm2_sr);
    out.cells.push_back(cell);
  }
  return out;
}

}  // namespace scattermeter::calib
