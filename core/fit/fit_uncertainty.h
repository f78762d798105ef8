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

// The linearised fit of (u, q, log s, nuisances): the image's information about them, divided by
// `noise_inflation`, plus the priors of scale and nuisances. An exact scale is fixed.
class FitUncertainty {
 public:
  FitUncertainty(const RecoveredReflectance& recovered, const std::vector<Nuisance>& nuisances,
                 const DipoleCurve& curve, double u, double q, double scale,
                 const ScalePrior& prior, double noise_inflation);

  // Covariance of (sigma_s', sigma_a), 1/mm^2, with the causes held fixed for which `known` is
  // true.
  Eigen::Matrix2d covariance(const std::function<bool(const std::string&)>& known) const;
  // The same without the nuisances that are not fitted: that of the chi-square itself.
  Eigen::Matrix2d covariance_of_fitted() const;
  // Standard deviation of log s; 0 for an exact scale.
  double log_scale_std() const;
  // The part of covariance(), with no cause known, by which noise scatters the estimate, in the
  // same units: more than if all causes were known, as the fit takes on noise where that makes it
  // less sensitive to them.
  Eigen::Matrix2d by_noise() const;
  // The causes besides noise: "scale" and the nuisances' groups, each once.
  std::vector<std::string> causes() const;

 private:
  // u, q and what else is free.
  std::vector<Eigen::Index> free_parameters() const;
  // Covariance of (sigma_s', sigma_a) for one of (u, q).
  Eigen::Matrix2d in_sigma(const Eigen::Matrix2d& of_u_and_q) const;

  double sigma_t_per_mm_;
  double q_;
  Eigen::MatrixXd information_;
  Eigen::VectorXd prior_;            // that of the priors, of every parameter
  std::vector<std::string> causes_;  // of every parameter
  Eigen::MatrixXd held_;             // J^T C std: parameters x nuisances that are not fitted
  std::vector<std::string> held_causes_;
  std::vector<Eigen::Index> movable_;  // free parameters other than u and q
};

// From once the rows in steps of 2 to `all` times as many; empty unless all > 1. with(n): the fit
// with n times the information of the rows.
std::vector<MoreRows> more_rows(const std::function<FitUncertainty(double)>& with, double all);

}  // namespace scattermeter
