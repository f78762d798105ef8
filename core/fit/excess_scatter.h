// Scatter of the rows beyond their noise, relative to the Monte Carlo error.
#pragma once

#include <Eigen/Core>

namespace scattermeter {

// Rows scatter about the predicted light by their noise, by the Monte Carlo error of the
// prediction, and by unstated errors: surface texture, grain in the material, the Monte Carlo noise
// of a rendering. Returns the ratio of all but the noise to the prediction's own error, at least 1:
//   sum w (residual^2 - noise) / sum w monte_carlo.
// The excess over 1 is taken as correlated between rows like the light of paths, that is, over long
// distances: independent errors of the rows would average out in the coefficients. Arguments of
// equal length (std::invalid_argument): residual of l; variances of noise and Monte Carlo; weights
// > 0 that depend on neither.
double excess_scatter(const Eigen::VectorXd& residual, const Eigen::VectorXd& noise_variance,
                      const Eigen::VectorXd& monte_carlo_variance, const Eigen::VectorXd& weights);

// That of rows which scatter by `most` of their light, beyond noise and Monte Carlo; 1 without
// Monte Carlo.
double most_scatter(double most, const Eigen::VectorXd& light,
                    const Eigen::VectorXd& monte_carlo_variance, const Eigen::VectorXd& weights);

}  // namespace scattermeter
