// Where the images put an eta that is far from the stated one.
#pragma once

#include <vector>

#include "core/estimation/channel_result.h"

namespace scattermeter {

// From the stated eta, by channel; 0: near it.
using EtaOffsets = std::vector<double>;

// What eta changes is not quite proportional to its offset, so where an image puts it 0.0075 and
// more from the stated one, its change is taken over that offset, to 0.005. Takes the offsets that
// the channels find; returns for which of the converged results it is another one now.
std::vector<bool> take_far_etas(const std::vector<ChannelResult>& results, EtaOffsets& offsets);

// Whether the image puts eta so far from the stated one that what this changes depends notably on
// the medium; not where the dipole misses the image.
bool finds_other_eta(const Estimate& estimate);

}  // namespace scattermeter
