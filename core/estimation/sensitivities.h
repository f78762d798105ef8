// How the images of all channels depend on what is uncertain of their lights.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/estimation.h"
#include "core/estimation/light_sensitivity.h"
#include "core/estimation/nuisances.h"

namespace scattermeter {

// Of every view and light, each for all the channels that have a first estimate there.
struct Sensitivities {
  std::map<LightKey, LightSensitivity> by_light;
  std::vector<std::map<LightKey, ChannelSensitivity>> of_channel;
};

// estimated: of each channel, whether its result holds a first estimate; others get none.
// Precondition: e.kept.weights has W of those channels' shots. Lights are made in parallel.
std::shared_ptr<const Sensitivities> sensitivities(const Estimation& e,
                                                   const std::vector<bool>& estimated,
                                                   const DistanceKnots& knots);

}  // namespace scattermeter
