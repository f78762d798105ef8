#include "core/fit/quantised_system.h"

#include <stdexcept>
#include <string>

#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

DenseSystem quantise(const DenseSystem& system, const WeightMatrix& uniform,
                     double rank_tolerance) {
  if (uniform.rows() != system.l.size()) {
    throw std::invalid_argument("quantise: " + std::to_string(uniform.rows()) + " rows for " +
                                std::to_string(system.l.size()) + " of the system");
  }
  const RecoveredReflectance r =
      recover_reflectance({uniform, system.l, system.std_l, {}, {}, {}}, rank_tolerance);
  // Q = S⁻¹ U inverse. Image and model go through the same matrix, so digits lost in `inverse` bias
  // nothing.
  const Eigen::VectorXd information = system.std_l.array().square().inverse();
  const Eigen::MatrixXd reduce =
      (information.asDiagonal() * (uniform * r.inverse)).transpose();  // Qᵀ S⁻¹
  DenseSystem out;
  out.weights = reduce * system.weights;
  out.l = reduce * system.l;
  out.std_l = Eigen::VectorXd::Ones(out.l.size());
  out.nuisances = system.nuisances;
  if (!system.nuisances.empty()) out.nuisance_columns = reduce * system.nuisance_columns;
  out.shot_rows = {out.l.size()};
  return out;
}

}  // namespace scattermeter
