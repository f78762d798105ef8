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
// objects stay there. While only some rows are chosen, transport does not begin.
std::vector<ChannelResult> fitted_from_where_seen(
    const Scene& scene, SeenShots& seen, EstimateOptions options,
    const std::function<std::vector<ChannelResult>(const EstimateOptions&)>& fit, Stopwatch& watch);

}  // namespace scattermeter::apps
