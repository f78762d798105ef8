// Noise on a synthetic image.
#pragma once

#include <algorithm>
#include <random>

#include "core/linear_shot.h"

namespace scattermeter::test_support {

// A system of one shot with independent normal noise of relative size `noise` of each l (and a
// floor of noise times a hundredth of the largest).
inline DenseSystem noisy_system(const WeightMatrix& weights, const Eigen::VectorXd& l, double noise,
                                unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  DenseSystem system{weights, l, Eigen::VectorXd(l.size())};
  for (Eigen::Index j = 0; j < l.size(); ++j) {
    system.std_l[j] = std::max(noise, 1e-6) * (l[j] + 0.01 * l.maxCoeff());
    system.l[j] += (noise > 0.0 ? 1.0 : 0.0) * system.std_l[j] * normal(random);
  }
  return system;
}

}  // namespace scattermeter::test_support
