// One set of samples from several exposures of a scene.
#pragma once

#include <vector>

#include "core/cfa_samples.h"

namespace scattermeter::capture {

// The exposures of a bracket, merged sample by sample, in counts of the first one's time t_0. With
// s_i counts of exposure i in t_i seconds, v_i their variance:
//   s = sum a_i s_i t_0 / t_i,   a_i = (t_i^2 / v_i) / sum (t_k^2 / v_k),
//   variance t_0^2 / sum (t_k^2 / v_k),
// over the exposures that are not clipped there. v_i is not that of the sample as it fell but that
// of what all of them expect, sum s_k / sum t_k times t_i: weights from each sample's own noise
// favour those that fell low, by one electron of each.
//
// - Clipped there: one of the 5 x 5 samples of the same phase around it, of its own file, is
//   marked so. By its own mark alone, samples near the clip level would take part only where their
//   noise fell low: the mean of those is up to 0.4 deviations low; by the 25 it is below 0.04.
// - Where that leaves none, the shortest exposure stands alone as if there were no other, with its
//   own mark: what is clipped in all stays clipped.
// - A sample that is expected below an exposure's floor_counts is left to longer ones.
// - A defect in one is a defect in all.
// floor_counts: the lowest of the exposures' in the same counts. part_of_exposure: the a_i.
// One exposure comes back as it is. Preconditions (std::invalid_argument): at least one; the same
// rectangle and filters; exposure_s > 0.
CfaSamples merged_samples(const std::vector<CfaSamples>& exposures);

}  // namespace scattermeter::capture
