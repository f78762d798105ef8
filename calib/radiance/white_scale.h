// Scale from counts to radiance from a white reference.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/light/led.h"

namespace scattermeter::calib {

// Radiance of a Lambertian plane under an LED per unit of axial intensity and of albedo: lobe cos /
// (pi r^2), 1/mm^2. 0 on the far side.
double white_radiance_per_intensity(const Led& led, const Eigen::Vector3d& point_mm,
                                    const Eigen::Vector3d& normal);

// Sums over the samples of one colour in one shot of the plane.
struct WhiteSum {
  double counts_per_s = 0;  // linearised counts over the true exposure time
  double variance = 0;      // of the sum
  double radiance = 0;      // W/(mm^2 sr): predicted, albedo times intensity times the above
  double relative_std = 0;  // of the error common to all samples of the shot: exposure
};

// The weight of a shot below: one over its squared relative standard deviation. 0 without light.
double white_weight(const WhiteSum& shot);

struct WhiteScale {
  double responsivity = 0;  // counts mm^2 sr / (W s)
  double relative_std = 0;  // noise and exposure only
  double worst = 0;         // largest relative departure of a shot from the mean
  bool ok = false;
};

// Mean of counts_per_s / radiance over the shots of a bracket, weighted by inverse variance.
WhiteScale fit_white_scale(const std::vector<WhiteSum>& shots);

}  // namespace scattermeter::calib
