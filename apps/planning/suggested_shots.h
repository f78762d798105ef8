// Shots that would reduce the uncertainties of a plan most.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "apps/planning/shot_forecaster.h"
#include "apps/rig/open_objects.h"
#include "apps/rig/rig.h"
#include "core/base/progress.h"
#include "core/fit/estimate.h"

namespace scattermeter::apps {

// Relative standard deviations of sigma_a with an LED at a position; NaN if there is no forecast.
struct LedPosition {
  Eigen::Vector3d position_mm;
  double alone = std::numeric_limits<double>::quiet_NaN();   // from this one shot
  double joined = std::numeric_limits<double>::quiet_NaN();  // from the planned shots and this one
};

// Positions of an LED on the upper hemisphere around an object's centre, at the distance of the LED
// `like` and aimed at the centre. All else, covariance included (rotated along), is that of `like`.
struct LedMap {
  std::string object;
  std::string like;
  Eigen::Vector3d center_mm = Eigen::Vector3d::Zero();
  double distance_mm = 0;
  Eigen::Vector3d camera_mm = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> planned_mm;  // LEDs of the planned shots
  std::vector<LedPosition> positions;
};

// An improvement: standard deviations relative to those of the planned shots.
struct Gain {
  std::string what;
  double sigma_s_prime_ratio = 1;
  double sigma_a_ratio = 1;
};

// For one material, in the channel with the largest relative uncertainty of sigma_a.
struct SuggestedShots {
  std::string material;
  char channel = 'R';
  double planned = 0;        // relative standard deviation of sigma_a from the planned shots
  double coarse_ratio = 0;   // the same by ShotForecaster, over `planned`
  std::vector<Gain> gains;   // the most helpful for sigma_a first
  std::vector<LedMap> maps;  // one per object; empty without an LED
};

struct SuggestionRequest {
  ExpectedMaterial material;
  Quantity sigma_a_per_mm;  // as forecast from the planned shots
};

// One result per request. Gains are ratios of forecasts by the forecaster; maps are such ratios
// times `planned`. A gain by shadow assumes a card that covers half of the object, its edge through
// the centre, exactly positioned and out of the camera's sight.
std::vector<SuggestedShots> suggested_shots(const Rig& rig,
                                            const std::vector<SuggestionRequest>& requests,
                                            const ScalePrior& scale, ShotForecaster& forecaster,
                                            Progress* progress);

}  // namespace scattermeter::apps
