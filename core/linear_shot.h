// One channel of one shot as a linear system in r.
#pragma once

#include <vector>

#include "core/distance_weights.h"
#include "core/observation.h"

namespace scattermeter {

// l = sum over lights of intensity * W_light r. References must outlive the struct.
struct LinearShot {
  struct Light {
    const WeightMatrix* weights;  // rows as in the observation, sr
    double intensity_W_per_sr;
  };
  std::vector<Light> lights;
  const ChannelObservation* observed;
};

// The rows that are used, as a dense system: weights (W), l (W/mm^2) and standard deviation of l.
struct DenseSystem {
  WeightMatrix weights;
  Eigen::VectorXd l;
  Eigen::VectorXd std_l;
};

// All used rows of the shots, one below the other. Precondition: all shots share their knots.
DenseSystem stack(const std::vector<LinearShot>& shots);

}  // namespace scattermeter
