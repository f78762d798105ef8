// Light that a lens spreads about what it shows.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter {

// For a share of 1 of the picture's light.
struct Halo {
  Eigen::VectorXd counts;    // on each row
  double beside_counts = 0;  // just beside the object
};

// Of a halo that reaches as far as a quarter of the object's width (standard deviation of a
// Gaussian). at_px, counts: position in the picture and mean light of each row of the object, as
// dense as to fill cells of a sixteenth of its size; all else is dark. Zero without extent.
Halo halo(const std::vector<Eigen::Vector2d>& at_px, const Eigen::VectorXd& counts);

}  // namespace scattermeter
