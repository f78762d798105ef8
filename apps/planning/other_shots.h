// What shots that the rig does not have would add.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/instrument/open_objects.h"
#include "apps/planning/coarse_shots.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"
#include "core/fit/estimate.h"

namespace scattermeter::apps {

// Relative standard deviations of sigma_a with the LED there, NaN where there is no answer.
struct LedPlace {
  Eigen::Vector3d position_mm;
  double alone = std::numeric_limits<double>::quiet_NaN();   // of this one shot
  double joined = std::numeric_limits<double>::quiet_NaN();  // of the planned shots and this one
};

// Places of an LED on the upper half of a sphere about an object's middle, at the distance of the
// LED `like`, aimed at the middle; else like that one, its covariance turned along.
struct LedMap {
  std::string object;
  std::string like;
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  double distance_mm = 0;
  Eigen::Vector3d camera_mm = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> planned_mm;  // LEDs of the planned shots
  std::vector<LedPlace> places;
};

// Standard deviations over those of the shots as planned.
struct Gain {
  std::string what;
  double sigma_s_prime_ratio = 1;
  double sigma_a_ratio = 1;
};

// For one material, in the channel whose sigma_a is least known.
struct OtherShots {
  std::string material;
  char channel = 'R';
  double planned = 0;  // relative standard deviation of sigma_a of the planned shots, as forecast
  // The same on coarse patches over it: 1 where they tell the same.
  double coarse_ratio = 0;
  std::vector<Gain> gains;   // the most helpful for sigma_a first
  std::vector<LedMap> maps;  // one an object; empty without an LED
};

// What is asked for.
struct OtherShotsTask {
  CoarseMaterial material;
  Quantity sigma_a_per_mm;  // forecast
};

// Ratios and maps from CoarseShots; the maps are those deviations over the coarse one of the
// planned shots times `planned`. Light is the channel's; a card that shadows half of an object, its
// edge through the middle, counts as exactly placed and out of the camera's sight.
std::vector<OtherShots> other_shots(const Rig& rig, const std::vector<OtherShotsTask>& tasks,
                                    const ScalePrior& scale, CoarseShots& coarse,
                                    Progress* progress);

}  // namespace scattermeter::apps
