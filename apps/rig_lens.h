// How well a rig knows its lens.
#pragma once

#include <Eigen/Core>

#include "apps/rig.h"
#include "calib/lens_parameters.h"

namespace scattermeter::apps {

// What independent unit errors do to the lens parameters: their covariance is root root^T.
using LensRoot = Eigen::Matrix<double, calib::kLensParameters, Eigen::Dynamic>;

// From the file that camera.intrinsics names: one column for each of its parameters. No columns
// without such a file, for one that states no covariance, and for one that states zero: the lens
// then counts as exact.
LensRoot lens_root(const RigCamera& camera);

}  // namespace scattermeter::apps
