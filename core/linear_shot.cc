#include "core/linear_shot.h"

#include <cmath>
#include <stdexcept>

namespace scattermeter {

DenseSystem stack(const std::vector<LinearShot>& shots) {
  Eigen::Index rows = 0;
  Eigen::Index cols = 0;
  for (const LinearShot& shot : shots) {
    rows += static_cast<Eigen::Index>(shot.observed->rows_used);
    for (const LinearShot::Light& light : shot.lights) {
      if (cols != 0 && light.weights->cols() != cols) {
        throw std::invalid_argument("stack: the shots have different knots");
      }
      cols = light.weights->cols();
    }
  }
  DenseSystem out{
      WeightMatrix::Zero(rows, cols), Eigen::VectorXd(rows), Eigen::VectorXd(rows), {}, {}, {}};
  Eigen::Index at = 0;
  for (const LinearShot& shot : shots) {
    const ChannelObservation& o = *shot.observed;
    out.shot_rows.push_back(static_cast<Eigen::Index>(o.rows_used));
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      for (const LinearShot::Light& light : shot.lights) {
        out.weights.row(at) +=
            light.intensity_W_per_sr * light.weights->row(static_cast<Eigen::Index>(j));
      }
      out.l[at] = o.l[j];
      out.std_l[at] = std::hypot(std::sqrt(o.variance[j]), shot.numerical_relative_std * o.l[j]);
      ++at;
    }
  }
  return out;
}

DenseSystem shot_of(const DenseSystem& system, std::size_t shot) {
  Eigen::Index first = 0;
  for (std::size_t i = 0; i < shot; ++i) first += system.shot_rows.at(i);
  const Eigen::Index rows = system.shot_rows.at(shot);
  DenseSystem out{system.weights.middleRows(first, rows),
                  system.l.segment(first, rows),
                  system.std_l.segment(first, rows),
                  {},
                  {},
                  {rows}};
  std::vector<Eigen::Index> columns;
  for (std::size_t v = 0; v < system.nuisances.size(); ++v) {
    const auto column = static_cast<Eigen::Index>(v);
    if (rows == 0 || system.nuisance_columns.col(column).segment(first, rows).isZero(0.0)) continue;
    columns.push_back(column);
    out.nuisances.push_back(system.nuisances[v]);
  }
  out.nuisance_columns =
      system.nuisance_columns.middleRows(system.nuisances.empty() ? 0 : first,
                                         system.nuisances.empty() ? 0 : rows)(Eigen::all, columns);
  return out;
}

}  // namespace scattermeter
