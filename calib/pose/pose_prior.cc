#include "calib/pose/pose_prior.h"

#include <cmath>

#include "calib/pose/edge_fit.h"

namespace scattermeter::calib {

std::vector<int> pose_parameters() {
  using edge_parameter::kPose;
  return {kPose, kPose + 1, kPose + 2, kPose + 3, kPose + 4, kPose + 5};
}

Eigen::MatrixXd loose_pose_prior(Eigen::Index size, double distance_mm) {
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i < 3; ++i) {
    prior(i, i) = 1 / std::pow(0.3, 2);
    prior(3 + i, 3 + i) = 1 / std::pow(0.3 * distance_mm, 2);
  }
  return prior;
}

}  // namespace scattermeter::calib
