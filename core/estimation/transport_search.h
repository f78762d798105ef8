// Search for the medium whose image by volume Monte Carlo matches the observed one.
#pragma once

#include "core/atlas/transport_atlas.h"
#include "core/base/progress.h"
#include "core/estimation/channel_result.h"
#include "core/estimation/estimation.h"
#include "core/fit/estimate.h"

namespace scattermeter {

// An estimating equation (core/fit/scattering_equation.h) is solved by Newton steps that start from
// the dipole's result. The light is that of the atlas, which traces what is missing: more paths as
// the search converges, until the Monte Carlo error is small. The pilot is the dipole's image,
// corrected part by part with the same paths (core/fit/part_light.h): their errors in the light of
// whole parts are some per mille, so that what they share biases the root by their square only. Z
// is the sum of the pilot's derivatives, with their detail and without, and of its light that the
// paths' own derivatives show. The weights account for the errors common to the rows of a cell.
// Errors of the shots beyond their noise widen the result like errors of the paths; if whole parts
// deviate, it is refused. How far the atlas is traced already changes the estimate, within its
// Monte Carlo error.
//
// Cube and pyramid under two LEDs (four shots, eta 1.3), exact scale, 60 s on two cores a channel,
// per mm. 2.19 / 0.002, three truths of 1.2 10^7 paths a light: 2.193, 2.194, 2.192 (each +- 0.005)
// / 0.00203, 0.00203, 0.00198 (each +- 0.00004). Truths of 4 10^6: 1.003 +- 0.002 / 0.00503 +-
// 0.00003 for 1.0 / 0.005 and 0.5004 +- 0.0009 / 0.00999 +- 0.00004 for 0.5 / 0.01. The dipole's
// best: 2.19 / 0.0003, 0.96 / 0.0018, 0.46 / 0.0031. With a scale known to 2 %: 2.186 +- 0.014 /
// 0.0021 +- 0.0002, 0.993 +- 0.006 / 0.0052 +- 0.0002, 0.496 +- 0.002 / 0.0102 +- 0.0002. With the
// uncorrected Z of the dipole and weights of independent rows, the deviation of the second was 2.7
// times as large and that of the third 6 times.
//
// Starts from the result's estimate and replaces it, its singles and agreement; if the search
// fails, the estimate is refused. Uses options.paths, looking_paths, time_limit_s and keep_rows.
// may_trace: otherwise, where the atlas lacks paths that the search asks for, it returns false and
// leaves the result as it is; such searches may run side by side. Throws Cancelled.
bool search_by_transport(const Scene& scene, const MaterialChannel& channel,
                         const DipoleSystem& dipole, TransportAtlas& atlas, bool may_trace,
                         const EstimateOptions& options, const ProgressStage& stage,
                         ChannelResult& result);

}  // namespace scattermeter
