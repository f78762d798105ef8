// Verdicts on a round of the search for a medium by transport.
#pragma once

#include "core/fit/estimate.h"
#include "core/fit/lack_of_fit.h"
#include "core/fit/scattering_equation.h"

namespace scattermeter {

// blocks: of paths that a round has traced for each light and view.

// From which on the covariances of a shot's parts are usable.
inline constexpr int kLeastBlocks = 64;
// Blocks of paths that a search is expected to end with; weights count on their Monte Carlo errors.
inline constexpr double kFinalPathBlocks = 512.0;

// Whether the step is so short that its nonlinear part, about half its square, is small against
// the standard deviation that the result would finally have, or small in itself. At first it has to
// be shorter, or paths would be spent at a point that proves to be too far away.
bool is_close(const ScatteringEquation::Step& step, int blocks);

// Whether the Monte Carlo error is small against all others, or smaller than anyone needs.
bool is_precise(const ScatteringEquation::Step& step, double sigma_a_per_mm, int blocks);

// Writes values, standard deviations, budget and scale at the step's end into the estimate.
void report_step(const ScatteringEquation::Step& step, Estimate& estimate);

// The step with a larger covariance where the image contradicts the stated scale.
ScatteringEquation::Step widened_by_scale(const ScatteringEquation& equation,
                                          const ScatteringEquation::ScaleTest& scale,
                                          ScatteringEquation::Step step);

// Adds the misfit, and the reasons for which the result must not be trusted, to an estimate whose
// values are reported.
void add_refusals(const LackOfFit& misfit, const ScatteringEquation::ScaleTest& scale, int blocks,
                  Estimate& estimate);

}  // namespace scattermeter
