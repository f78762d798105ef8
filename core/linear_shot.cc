#include "core/linear_shot.h"

#include <cmath>
#include <stdexcept>

namespace scattermeter {

DenseSystem stack(const std::vector<LinearShot>& shots, double numerical_relative_std) {
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
      WeightMatrix::Zero(rows, cols), Eigen::VectorXd(rows), Eigen::VectorXd(rows), {}, {}};
  Eigen::Index at = 0;
  for (const LinearShot& shot : shots) {
    const ChannelObservation& o = *shot.observed;
    for (std::size_t j = 0; j < o.l.size(); ++j) {
      if (o.state[j] != RowState::kUsed) continue;
      for (const LinearShot::Light& light : shot.lights) {
        out.weights.row(at) +=
            light.intensity_W_per_sr * light.weights->row(static_cast<Eigen::Index>(j));
      }
      out.l[at] = o.l[j];
      out.std_l[at] = std::hypot(std::sqrt(o.variance[j]), numerical_relative_std * o.l[j]);
      ++at;
    }
  }
  return out;
}

}  // namespace scattermeter
