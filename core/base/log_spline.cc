#include "core/base/log_spline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace scattermeter {

LogSpline::LogSpline(std::vector<double> breaks) {
  if (breaks.size() < 2) throw std::invalid_argument("LogSpline: fewer than two breaks");
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    if (!(breaks[i] > breaks[i - 1])) {
      throw std::invalid_argument("LogSpline: the breaks do not increase");
    }
  }
  padded_.assign(3, breaks.front());
  padded_.insert(padded_.end(), breaks.begin(), breaks.end());
  padded_.insert(padded_.end(), 3, breaks.back());
}

Eigen::RowVectorXd LogSpline::row(double t, int derivative) const {
  t = std::clamp(t, padded_.front(), padded_.back());
  const auto n = static_cast<std::size_t>(size());
  // The interval: padded_[at] <= t < padded_[at + 1]; the last break belongs to the last interval.
  std::size_t at = 3;
  while (at + 1 < n && t >= padded_[at + 1]) ++at;
  // All splines of order 1 .. 4 - derivative that are nonzero on the interval (Cox, de Boor), then
  // the derivatives by differences of lower orders.
  std::vector<double> value(5, 0.0);  // value[k]: spline at - order + 1 + k, of the current order
  value[0] = 1.0;
  for (std::size_t order = 2; order <= 4; ++order) {
    const bool differ = static_cast<int>(order) > 4 - derivative;
    std::vector<double> next(5, 0.0);
    for (std::size_t k = 0; k + 1 < order; ++k) {
      const std::size_t left = at + 2 - order + k;  // of the lower-order spline's support
      const double width = padded_[left + order - 1] - padded_[left];
      const double up =
          differ ? static_cast<double>(order - 1) / width : (t - padded_[left]) / width;
      const double down = differ ? -up : (padded_[left + order - 1] - t) / width;
      next[k] += value[k] * down;
      next[k + 1] += value[k] * up;
    }
    value = next;
  }
  // c_i = theta_0 - sum of theta_1 .. theta_i: theta_i collects all later splines.
  Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(size());
  double later = 0.0;
  for (std::size_t i = at + 1; i-- > 1;) {
    if (i + 3 >= at) later += value[i + 3 - at];
    out[static_cast<Eigen::Index>(i)] = -later;
  }
  out[0] = derivative == 0 ? 1.0 : 0.0;
  return out;
}

Eigen::MatrixXd LogSpline::roughness() const {
  const Eigen::Index intervals = size() - 3;
  Eigen::MatrixXd out(2 * intervals, size());
  for (Eigen::Index i = 0; i < intervals; ++i) {
    const double a = padded_[static_cast<std::size_t>(i) + 3];
    const double h = padded_[static_cast<std::size_t>(i) + 4] - a;
    for (Eigen::Index g = 0; g < 2; ++g) {
      const double t = a + h * (g == 0 ? 0.21132486540518712 : 0.78867513459481288);
      const double weight = 0.5 * h * std::exp(0.5 * (t - padded_.front()));
      out.row(2 * i + g) = std::sqrt(weight) * (row(t, 3) - 0.5 * row(t, 2));
    }
  }
  return out;
}

}  // namespace scattermeter
