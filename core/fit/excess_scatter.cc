#include "core/fit/excess_scatter.h"

#include <algorithm>
#include <stdexcept>

namespace scattermeter {

double excess_scatter(const Eigen::VectorXd& residual, const Eigen::VectorXd& noise_variance,
                      const Eigen::VectorXd& monte_carlo_variance, const Eigen::VectorXd& weights) {
  const Eigen::Index n = residual.size();
  if (noise_variance.size() != n || monte_carlo_variance.size() != n || weights.size() != n) {
    throw std::invalid_argument("excess_scatter: lengths differ");
  }
  const double own = weights.dot(monte_carlo_variance);
  if (!(own > 0.0)) return 1.0;
  return std::max(1.0, weights.dot(residual.cwiseAbs2() - noise_variance) / own);
}

double most_scatter(double most, const Eigen::VectorXd& light,
                    const Eigen::VectorXd& monte_carlo_variance, const Eigen::VectorXd& weights) {
  const double own = weights.dot(monte_carlo_variance);
  return own > 0.0 ? 1.0 + most * most * weights.dot(light.cwiseAbs2()) / own : 1.0;
}

}  // namespace scattermeter
