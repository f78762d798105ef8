// Departures of the exposures of a bracket from one another.
#pragma once

#include <vector>

#include "core/camera/cfa_samples.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::capture {

// The departure of each exposure from the others. `merged` is merged_samples(exposures). Over all
// samples to which the exposure and at least one other contribute, the sum of its counts / t is
// compared with the sum of (counts of the others / times of the others). Throws
// std::invalid_argument if `merged` does not have the shares of all exposures.
std::vector<ExposureDeparture> exposure_departures(const std::vector<CfaSamples>& exposures,
                                                   const CfaSamples& merged);

}  // namespace scattermeter::capture
