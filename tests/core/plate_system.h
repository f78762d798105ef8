// The half-lit plate with its weights, made once for a whole test program.
#pragma once

#include <cmath>

#include "core/dipole_curve.h"
#include "core/medium.h"
#include "tests/core/half_lit_plate.h"

namespace scattermeter::test_support {

inline constexpr double kEta = 1.3;  // of image()

struct PlateSystem {
  HalfLitPlate plate{1.0};
  DistanceKnots knots = plate.knots();
  WeightMatrix w = plate.weights(knots);

  // By the weights themselves, at kEta: for tests of what follows after the forward model.
  Eigen::VectorXd image(const Medium& medium) const {
    const double t = medium.sigma_t_prime_per_mm();
    return w * dipole_curve(knots, std::log(t), medium.sigma_a_per_mm / t, kEta).r;
  }
};

inline const PlateSystem& plate() {
  static const PlateSystem p;
  return p;
}

}  // namespace scattermeter::test_support
