// Where the search by transport starts.
#pragma once

#include <span>

#include "core/estimation/channel_result.h"

namespace scattermeter {

// Where the dipole does not hold, its estimates are off by what the body's shape does to them, and
// that is nearly the same in like media: moves the estimate (so far the dipole's) as transport
// moved the dipole's estimate of the channel with the most similar one, sigma_s' by their ratio and
// sigma_a by their difference. Leaves it as it is if no channel is similar, within a factor of e in
// sigma_s'. found: channels that transport has already searched, among others.
void start_like_others(std::span<const ChannelResult> found, Estimate& estimate);

}  // namespace scattermeter
