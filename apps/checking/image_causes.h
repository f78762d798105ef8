// Which single change of the rig explains the departures of the images from the joint model.
#pragma once

#include <string>
#include <vector>

#include "core/fit/linear_shot.h"
#include "core/fit/shot_departure.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

struct ImageCause {
  std::string text;    // "led1 displaced": the same for all channels
  std::string advice;  // what a user should do
  int parameters = 0;
  double chi2_drop = 0;  // by freeing these parameters, in deviations of the best cause's residual
  double share = 0;      // of what the joint model leaves over the noise, 0 .. 1
};

// Generalised least squares of the rows with the columns of each cause free in turn: the place of
// each LED, its power, the power of each shot, light from elsewhere (even on the object, a level
// for each shot), the pose (camera knocked or object displaced), eta. The other nuisances keep
// their priors: those of `system`, but for LEDs with the standard deviation of their position in
// `rig`. Sorted by chi2_drop - parameters ln(rows). shots: of the rows, in order. Precondition: as
// shot_departures().
std::vector<ImageCause> image_causes(const Scene& rig, const std::vector<const SceneShot*>& shots,
                                     const DenseSystem& system, const LinearModel& model);

}  // namespace scattermeter::apps
