// A wide prior that only keeps the fit of an outline from diverging.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter::calib {

// The six parameters of the pose (edge_parameter::kPose), for EdgeFitOptions::free.
std::vector<int> pose_parameters();

// EdgeFitOptions::prior for `size` parameters: standard deviations of 0.3 rad and 0.3 of the
// distance for the pose, nothing for the other parameters.
Eigen::MatrixXd loose_pose_prior(Eigen::Index size, double distance_mm);

}  // namespace scattermeter::calib
