// Where the search by transport starts.
#pragma once

#include <span>
#include <string>

#include "core/estimation/channel_result.h"

namespace scattermeter {

// Moves the start (so far the dipole's estimate) by what transport has found already, `found`
// holding channels that it has searched, among others. Where the dipole does not hold, its
// estimates are off by what the body's shape does to them, and that is nearly the same in like
// media: as transport moved the dipole's estimate of the channel with the most similar one, within
// a factor of e in sigma_s', sigma_s' by their ratio and sigma_a by their difference. Where the
// dipole determines nothing (a standard deviation beyond half of sigma_s'), to the estimate of
// another channel of the material, or else of another material. Only from channels that are not
// refused; without any, the start stays where it is.
void start_like_others(std::span<const ChannelResult> found, const std::string& material,
                       Estimate& start);

}  // namespace scattermeter
