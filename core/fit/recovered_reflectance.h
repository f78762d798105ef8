// The diffuse reflectance r recovered from an image without a model.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include "core/fit/image_information.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// r = W⁺ l by weighted least squares (paper eq. 28, each row divided by its standard deviation),
// kept in the coordinates in which its errors are independent. The information Wᵀ S⁻² W (S:
// standard deviations) is scaled to a unit diagonal D⁻¹ . D⁻¹ first, since knots and nuisances
// differ by many orders of magnitude, then decomposed as V diag(lambda) Vᵀ; with the K eigenvectors
// whose lambda exceeds `rank_tolerance` times the largest:
//   sqrt_information = diag(sqrt(lambda)) Vᵀ D   (K rows),   whitened = sqrt_information r,
// so that a candidate R on the knots has chi-square |sqrt_information R - whitened|^2 + floor_chi2
// on the image itself. Directions of r about which the image has no information are in no row. If
// the system has nuisances, their columns follow those of W, and a candidate is (R, v).
struct RecoveredReflectance {
  Eigen::MatrixXd sqrt_information;
  Eigen::VectorXd whitened;
  Eigen::MatrixXd inverse;  // sqrt_information * inverse is the identity
  double floor_chi2 = 0;    // of the best r
  std::size_t rows = 0;     // rows of the image
  // Ratio of the rows' variance, from the residual of the best r, to the stated one; at least 1.
  double noise_excess() const;
  // The best-fitting r, 1/mm^2 on the knots; if it is not unique, the shortest in the scaled
  // metric.
  Eigen::VectorXd values() const;
};

RecoveredReflectance recover_reflectance(const ImageInformation& image,
                                         double rank_tolerance = 1e-13);
RecoveredReflectance recover_reflectance(const DenseSystem& system, double rank_tolerance = 1e-13);

}  // namespace scattermeter
