// What an image says of r and the nuisances, as normal equations.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/linear_shot.h"

namespace scattermeter {

// Of l = A x with A = (W, nuisance columns) and rows of standard deviation S. Sums of those of
// single shots are those of all shots together, so that each shot's rows are gone through once.
struct ImageInformation {
  Eigen::MatrixXd information;  // Aᵀ S⁻² A, whole
  Eigen::VectorXd right;        // Aᵀ S⁻² l
  double l2 = 0;                // |S⁻¹ l|^2
  std::size_t rows = 0;

  ImageInformation& operator+=(const ImageInformation& other);
};

ImageInformation image_information(const DenseSystem& system);

// Of each shot (DenseSystem::shot_rows), with all of the system's columns.
std::vector<ImageInformation> information_by_shot(const DenseSystem& system);

// With the knots' columns and those of some nuisances only, in ascending order.
ImageInformation with_nuisances(const ImageInformation& all, Eigen::Index n_knots,
                                const std::vector<Eigen::Index>& nuisances);

}  // namespace scattermeter
