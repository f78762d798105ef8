// What a measurement tells of its shots besides its estimates.
#pragma once

#include <string>
#include <vector>

#include "apps/instrument/measure.h"
#include "core/scene/lit_objects.h"
#include "core/scene/observed_shot.h"

namespace scattermeter::apps {

// Those of shots with several exposures, in the order of the shots.
std::vector<MergedBracket> brackets_of(const std::vector<ObservedShot>& shots);

// Samples outside the objects, patches that no shot sees or no light reaches, and shadow rays.
Skipped skipped_of(const std::vector<ObservedShot>& shots, const LitObjects& lit);

// Where shots are noisier than their noise model says (ChannelObservation::noise_excess): how many
// channels of shots, and which is the noisiest; else empty.
std::string noise_note(const std::vector<ObservedShot>& shots);

}  // namespace scattermeter::apps
