// --model auto: whether the dipole will do.
#pragma once

#include <string>

#include "core/estimation/channel_result.h"

namespace scattermeter {

// Why a channel wants transport, half a sentence; empty: the dipole holds. Every body is far from
// the half-space that the dipole is made for; whether that matters is seen in the image better than
// from the shape: on a 20 mm cube the dipole misses several per cent of the light. Its result
// is kept where it is not refused, its misfit is insignificant or below a thousandth of the image,
// the shots agree, and the image is good enough to have shown a misfit of half a per cent.
// result: of the dipole; image_in_std: how many deviations all of the image is that it was fitted
// to, |l / std|.
std::string why_transport(const ChannelResult& result, double image_in_std);

}  // namespace scattermeter
