// How much shots err beyond their noise, in units of what paths would.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

// Rows scatter about the predicted light by their noise, by the Monte Carlo error of the
// prediction, and by what nobody states: the texture of a surface, grain in the material, a
// rendering by Monte Carlo. The ratio of all but the noise to the prediction's own error, at least
// 1:
//   sum w (residual^2 - noise) / sum w monte_carlo.
// What exceeds 1 is taken as correlated from row to row as the light of paths is, which is far: an
// error of the rows alone would average out in the coefficients.
// All of one length (std::invalid_argument): residual of l; variances of noise and Monte Carlo;
// weights > 0 that follow neither.
double excess_scatter(const Eigen::VectorXd& residual, const Eigen::VectorXd& noise_variance,
                      const Eigen::VectorXd& monte_carlo_variance, const Eigen::VectorXd& weights);

}  // namespace scattermeter
