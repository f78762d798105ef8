// The fit of shots from where they show their objects to lie.
#pragma once

#include <functional>
#include <vector>

#include "apps/instrument/seen_shots.h"
#include "core/base/stopwatch.h"
#include "core/estimation/channel_result.h"
#include "core/estimation/estimate.h"
#include "core/scene/scene.h"

namespace scattermeter::apps {

// Fits the shots, opens them again from where the fit shows the objects to lie, and so on until the
// objects stay there. While only some rows are chosen, transport does not begin. finds_elsewhere:
// asked before the shots are opened from elsewhere for the first time, and finds_leds by each of
// the dipole's fits, before transport begins; where one is true, that fit is returned.
std::vector<ChannelResult> fitted_from_where_seen(
    const Scene& scene, SeenShots& seen, EstimateOptions options,
    const std::function<std::vector<ChannelResult>(const EstimateOptions&)>& fit,
    const std::function<bool()>& finds_elsewhere,
    const std::function<bool(const std::vector<ChannelResult>&)>& finds_leds, Stopwatch& watch);

}  // namespace scattermeter::apps
