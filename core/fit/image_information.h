// The information of an image on r and the nuisances, as normal equations.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/fit/image_rows.h"
#include "core/fit/linear_shot.h"

namespace scattermeter {

// Of l = A x with A = (W, nuisance columns) and rows of standard deviation S.
struct ImageInformation {
  Eigen::MatrixXd information;  // Aᵀ S⁻² A, whole
  Eigen::VectorXd right;        // Aᵀ S⁻² l
  double l2 = 0;                // |S⁻¹ l|^2
  std::size_t rows = 0;
  // Every number of the rows is finite and every deviation above 0.
  bool is_sound = true;
};

ImageInformation image_information(const DenseSystem& system);

// Of one shot: nuisances[k] is the place, among those of the image, of the one whose column stands
// k-th behind the knots'.
struct ShotInformation {
  ImageInformation image;
  std::vector<Eigen::Index> nuisances;
};

// Of each shot, gone through once; shots in parallel.
std::vector<ShotInformation> information_by_shot(const ImageRows& image);

// Of all these shots together, with all of the image's nuisances; the digits depend on the shots'
// order alone.
ImageInformation joint_information(const std::vector<ShotInformation>& shots,
                                   std::size_t n_nuisances);

}  // namespace scattermeter
