// Verdicts on a round of the search for a medium by transport.
#pragma once

#include "core/estimation/transport_round.h"
#include "core/fit/estimate.h"

namespace scattermeter {

// Blocks of paths that a search is expected to end with; weights count on their Monte Carlo errors.
inline constexpr double kFinalPathBlocks = 512.0;

// Whether the step is so short that its nonlinear part, about half its square, is small against
// the standard deviation that the result would finally have, or small in itself. At first it has to
// be shorter, or paths would be spent at a point that proves to be too far away.
bool is_close(const TransportRound& round);

// Whether the Monte Carlo error is small against all others, or smaller than anyone needs.
bool is_precise(const TransportRound& round);

// Writes values, standard deviations, budget and scale at the step's end into the estimate.
void report_step(const ScatteringEquation::Step& step, Estimate& estimate);

// The joint step with a larger covariance where the image contradicts the stated scale.
ScatteringEquation::Step widened_by_scale(const TransportRound& round);

// Adds the misfit, and the reasons for which the result must not be trusted.
void add_refusals(const TransportRound& round, Estimate& estimate);

}  // namespace scattermeter
