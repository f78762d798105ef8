#include "core/fit/cell_step.h"

#include <Eigen/Core>

namespace scattermeter {

ScatteringEquation::Step step_by_cells(const DenseSystem& system, const ShotParts& parts,
                                       const ScalePrior& scale, const ScatteringImage& image,
                                       const ScatteringPoint& at, double scatter) {
  const ShotParts::Sums& sums = parts.cells();
  const ShotParts::Sums of_variance = sums.cwiseAbs2();
  DenseSystem cells;
  cells.l = sums * system.l;
  cells.std_l = (of_variance * system.std_l.cwiseAbs2()).cwiseSqrt();
  cells.nuisances = system.nuisances;
  cells.nuisance_columns = sums * system.nuisance_columns;
  const ScatteringImage light{sums * image.l, sums * image.per_log_sigma_s,
                              sums * image.per_sigma_a, of_variance * image.variance};
  const ScatteringEquation equation(cells, scale, {{light}}, at, scatter);
  const Eigen::MatrixXd& projection = equation.projection(0);
  return equation.step({light, light},
                       projection * light.variance.asDiagonal() * projection.transpose(), at,
                       scatter);
}

}  // namespace scattermeter
