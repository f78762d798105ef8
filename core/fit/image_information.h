// The information of an image about r and the nuisances, as normal equations.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/fit/image_rows.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// Normal equations of l = A x with A = (W, nuisance columns) and S the rows' standard deviations.
struct ImageInformation {
  Eigen::MatrixXd information;  // Aᵀ S⁻² A, whole
  Eigen::VectorXd right;        // Aᵀ S⁻² l
  double l2 = 0;                // |S⁻¹ l|^2
  std::size_t rows = 0;
  // Every number in the rows is finite and every standard deviation above 0.
  bool is_sound = true;
};

ImageInformation image_information(const DenseSystem& system);

// The information of one shot. nuisances[k] is the index, among the image's nuisances, of the k-th
// column after the knots'.
struct ShotInformation {
  ImageInformation image;
  std::vector<Eigen::Index> nuisances;
};

// For each shot, visited once; shots in parallel.
std::vector<ShotInformation> information_by_shot(const ImageRows& image);

// For all these shots together, with all of the image's nuisances; the digits depend only on the
// order of the shots.
ImageInformation joint_information(const std::vector<ShotInformation>& shots,
                                   std::size_t n_nuisances);

}  // namespace scattermeter
