// Departures of the shots from a joint model by transport.
#pragma once

#include <vector>

#include "core/estimation/channel_result.h"
#include "core/fit/linear_shot.h"
#include "core/fit/shot_departure.h"
#include "core/scene/observed_shot.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// What transport says about the rig as stated, in place of what the dipole's derivatives make of
// its images, whose rows share the errors of their paths: the value of each quantity by the image
// alone, with the deviation that it has where all statements hold. Their ratio is the pull that
// `measure` judges (core/fit/prior_pulls.h). The light of a shot counts where the shots disagree.
// nuisances: of departures.nuisances; shots: of the result, in order.
void take_evidence(const Scene& stated, const ChannelResult& result,
                   const std::vector<Nuisance>& nuisances,
                   const std::vector<const ObservedShot*>& shots, ShotDepartures& departures);

}  // namespace scattermeter::apps
