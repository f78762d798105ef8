#include "core/fit/residual.h"

#include <cmath>
#include <stdexcept>

namespace scattermeter {

Residual residual(const Eigen::VectorXd& l, const Eigen::VectorXd& predicted,
                  const Eigen::VectorXd& std_l) {
  if (l.size() == 0 || l.size() != predicted.size() || l.size() != std_l.size()) {
    throw std::invalid_argument("residual: lengths differ or are zero");
  }
  const Eigen::VectorXd difference = l - predicted;
  Residual out;
  out.chi2 = difference.cwiseQuotient(std_l).squaredNorm();
  const double n = static_cast<double>(l.size());
  const double rms = std::sqrt(difference.squaredNorm() / n);
  out.rms_relative = rms / std::sqrt(l.squaredNorm() / n);
  out.psnr_db = 20.0 * std::log10(l.maxCoeff() / rms);
  return out;
}

}  // namespace scattermeter
