// One channel of one shot as a linear system in r.
#pragma once

#include <string>
#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/view/observation.h"

namespace scattermeter {

// l = sum over lights of intensity * W_light r. References must outlive the struct.
struct LinearShot {
  struct Light {
    const WeightMatrix* weights;  // rows as in the observation, sr
    double intensity_W_per_sr;
  };
  std::vector<Light> lights;
  const ChannelObservation* observed;
  // Error of the prediction itself (discretisation), relative to l; it is added to the variance of
  // each row.
  double numerical_relative_std = 0;
};

// A quantity other than the material that affects the image and is known only to within a standard
// deviation: an LED's position, the camera's pose, eta. Measured from its nominal value.
struct Nuisance {
  std::string group;  // its line in the budget: "LED position", "pose", ...
  double std = 0;     // of the prior; the prior's mean is 0
  // True: fitted along with the material. False: held at 0, and its possible effect on the estimate
  // only widens the uncertainty (errors of the method itself, whose shape is not known well enough
  // to be fitted).
  bool fitted = true;
  std::string name = {};  // unique ("led1.position0"); may be empty
};

// The used rows as a dense system: weights (W), l (W/mm^2) and standard deviation of l.
// l = W r + nuisance_columns * v, with v the deviations of the nuisances from nominal.
struct DenseSystem {
  WeightMatrix weights;
  Eigen::VectorXd l;
  Eigen::VectorXd std_l;
  std::vector<Nuisance> nuisances = {};      // may be empty; the fitted ones come first
  Eigen::MatrixXd nuisance_columns = {};     // rows x nuisances: dl / dv
  std::vector<Eigen::Index> shot_rows = {};  // number of rows of each shot, in order
  // By transport: what a unit of this nuisance changes beyond its column, with the noise of paths.
  // It moves the estimate as it projects on it, and so widens it; weights and pulls, which would
  // take the noise for structure that tells the nuisance from all else, have the column alone.
  struct BeyondColumn {
    Eigen::Index nuisance = -1;  // -1: none
    Eigen::VectorXd l = {};      // by row
  };
  BeyondColumn beyond_column = {};
};

// Some of the rows, in ascending order, with all nuisances.
DenseSystem selected(const DenseSystem& system, const std::vector<Eigen::Index>& rows);

// The nuisances that affect the rows of one shot, ascending.
std::vector<Eigen::Index> nuisances_of_shot(const DenseSystem& system, std::size_t shot);

// The rows of one shot, and the nuisances that affect them.
DenseSystem shot_of(const DenseSystem& system, std::size_t shot);

// All used rows of the shots, one below the other. Precondition: all shots have the same knots.
DenseSystem stack(const std::vector<LinearShot>& shots);

}  // namespace scattermeter
