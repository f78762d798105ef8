// What a round of the search for a medium by transport is good for.
#pragma once

#include "core/estimation/transport_round.h"
#include "core/fit/estimate.h"

namespace scattermeter {

// Of the time for all, what rows err by with this many blocks of paths.
inline constexpr double kFinalPathBlocks = 512.0;

// A step so short that what is not linear in it, about half its square, is small against the
// deviation that the answer would have in the end, or small in itself. At first it has to be
// shorter, or paths would be spent on a place that proves too far.
bool near(const TransportRound& round);

// Monte Carlo is small against the rest, or against what anyone asks for.
bool fine(const TransportRound& round);

// Values, deviations, budget and scale of a step's end.
void tell(const ScatteringEquation::Step& step, Estimate& estimate);

// The joint step, wider where the image contradicts the stated scale.
ScatteringEquation::Step doubted(const TransportRound& round);

// Adds the misfit, and the reasons for which the answer must not be trusted.
void judge(const TransportRound& round, Estimate& estimate);

}  // namespace scattermeter
