// Information about the reflectance alone, with the nuisances integrated out.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/fit/recovered_reflectance.h"

namespace scattermeter {

enum class NuisanceUse {
  kFitted,  // those that are not fitted stay at 0
  kAll,     // those that are not fitted are integrated out as well
};

// chi-square of an r on the knots = |kernel r - data|^2 + floor_chi2, with the nuisances at their
// optimum for that r (normal priors of mean 0 included), which for normal errors is equivalent to
// integrating over them.
struct MarginalInformation {
  Eigen::MatrixXd kernel;  // columns: the knots, mm^2
  Eigen::VectorXd data;
  // The change of `kernel r` by one standard deviation of each nuisance held at 0.
  Eigen::MatrixXd held;
};

// Precondition: `recovered` comes from a system with these nuisances, the fitted ones first, and
// n_knots columns of W (std::invalid_argument where the number of columns differs). A nuisance
// whose standard deviation is not above 0 stays fixed. Householder reflections act on the priors'
// rows and the columns together, so that a prior far wider than the noise costs no digits.
MarginalInformation marginal_information(const RecoveredReflectance& recovered,
                                         const std::vector<Nuisance>& nuisances,
                                         Eigen::Index n_knots, NuisanceUse use);

}  // namespace scattermeter
