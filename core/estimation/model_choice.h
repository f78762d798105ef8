// --model auto: the choice between dipole and transport.
#pragma once

#include <string>

#include "core/estimation/channel_result.h"

namespace scattermeter {

// Whether a model's misfit is significant and exceeds a thousandth of the image.
bool misses_image(const Estimate& estimate);

// Why a channel needs transport, as a phrase; empty: the dipole is adequate. No body is the
// half-space for which the dipole is derived; whether that matters is better judged from the image
// than from the shape: on a 20 mm cube the dipole misses several per cent of the light. Its result
// is kept if its misfit is insignificant or below a thousandth of the image, the shots agree, and
// the image is good enough to have shown a misfit of half a per cent: a refused one, too, as what
// contradicts the rig is then not the dipole. By paths of true transport it misses 1.6 to 6 % of a
// cube, a pyramid and a sphere.
// result: of the dipole.
std::string why_transport(const ChannelResult& result);
// What the dipole may miss without being seen to, relative to the image.
double hidden_by_noise(const ChannelResult& result);

}  // namespace scattermeter
