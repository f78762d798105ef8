// Sensitivities of the images of all channels to the uncertain quantities of the setup.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "core/diffusion/distance_weights.h"
#include "core/estimation/edge_width.h"
#include "core/estimation/estimation.h"
#include "core/estimation/far_eta.h"
#include "core/nuisances/light_sensitivity.h"
#include "core/nuisances/nuisances.h"

namespace scattermeter {

// For every view and light, for all channels that have a first estimate.
struct Sensitivities {
  std::map<LightKey, LightSensitivity> by_light;
  std::vector<std::map<LightKey, ChannelSensitivity>> of_channel;
};

// Where the changes that are not linear hold.
struct ChangesAt {
  EdgeWidths edge_widths_mm;
  EtaOffsets eta_offsets;  // empty: near the stated eta
};
// Takes those that the results show; returns for which of them one is another now.
std::vector<bool> take_found(const Scene& scene, const std::vector<ChannelResult>& results,
                             ChangesAt& at);

// estimated: for each channel, whether its result contains a first estimate; others get no
// sensitivities. Precondition: e.kept.weights contains W for those channels' shots. Lights are
// computed in parallel.
std::shared_ptr<const Sensitivities> sensitivities(const Estimation& e,
                                                   const std::vector<bool>& estimated,
                                                   const DistanceKnots& knots,
                                                   const ChangesAt& at = {});

}  // namespace scattermeter
