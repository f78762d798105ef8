// A prior so wide that it only keeps an outline's fit from running away.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter::calib {

// The six parameters of the pose (edge_parameter::kPose), for EdgeFitOptions::free.
std::vector<int> pose_parameters();

// EdgeFitOptions::prior of `size` parameters: the pose to 0.3 rad and 0.3 of its distance, nothing
// else.
Eigen::MatrixXd loose_pose_prior(Eigen::Index size, double distance_mm);

}  // namespace scattermeter::calib
