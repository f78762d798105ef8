// Covariance and budget of a fit at its optimum.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/diffusion/dipole_curve.h"
#include "core/fit/estimate.h"
#include "core/fit/linear_shot.h"
#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

// The linearised fit of (u, q, log s, nuisances): the information that the image holds about them,
// divided by `noise_inflation`, and the priors of scale and nuisances. An exact scale does not
// move.
class FitUncertainty {
 public:
  FitUncertainty(const RecoveredReflectance& recovered, const std::vector<Nuisance>& nuisances,
                 const DipoleCurve& curve, double u, double q, double scale,
                 const ScalePrior& prior, double noise_inflation);

  // Covariance of (sigma_s', sigma_a), 1/mm^2, with those causes held fixed for which `known` is
  // true.
  Eigen::Matrix2d covariance(const std::function<bool(const std::string&)>& known) const;
  // The same without the nuisances that are not fitted: what the chi-square itself holds.
  Eigen::Matrix2d covariance_of_fitted() const;
  // Standard deviation of log s; 0 for an exact scale.
  double log_scale_std() const;
  // The causes beside noise: "scale" and the nuisances' groups, each once.
  std::vector<std::string> causes() const;

 private:
  double sigma_t_per_mm_;
  double q_;
  Eigen::MatrixXd information_;
  std::vector<std::string> causes_;  // of every parameter
  Eigen::MatrixXd held_;             // J^T C std: parameters x nuisances that are not fitted
  std::vector<std::string> held_causes_;
  std::vector<Eigen::Index> movable_;  // parameters beside u and q that may move
};

}  // namespace scattermeter
