// A small rig whose radiance calibration is simulated in memory.
#pragma once

#include <string>

#include "apps/calibrate_radiance.h"
#include "apps/radiance_shots.h"
#include "apps/rig.h"

namespace scattermeter::apps {

// 120 x 80 pixels times scale squared; dark frames, pairs of flats at two lamps and six times, a
// bracket of a white plane, a glare shot; a camera with everything that truth.sensor knows.
Rig radiance_rig(int scale = 1);

// The seed's shots through calibrate_radiance(): the camera is truth's, what is told to the
// calibration is rig's.
RadianceResult calibrated(const Rig& rig, const Rig& truth, std::uint64_t seed);

// log(light / recorded) of the simulated sensor.
double true_log_ratio(const Rig& rig, double recorded);

}  // namespace scattermeter::apps
