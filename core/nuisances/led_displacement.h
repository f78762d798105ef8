// Where the shots show that an LED stands.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/fit/prior_pulls.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter {

struct LedsElsewhere {
  // What the derivatives by position, axis and exponent leave out of the light of the LED that is
  // farthest from where it was computed, relative to that light: the squares of its motion over its
  // distance, of its turn and of the change of its lobe.
  double bent = 0;
  std::map<std::string, Eigen::VectorXd> displacements;  // Light::displacement(), by LED
};

// The most probable LEDs of the shots, by the pulls of all channels together; calibrated ones,
// whose errors are combinations of these quantities, stay.
LedsElsewhere leds_elsewhere(const Scene& scene, std::span<const ObservedShot> shots,
                             const std::vector<PriorPull>& pulls);

}  // namespace scattermeter
