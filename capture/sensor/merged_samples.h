// Merging of several exposures of a scene.
#pragma once

#include <vector>

#include "core/camera/cfa_samples.h"

namespace scattermeter::capture {

// Merges the exposures of a bracket sample by sample, in counts of the time t_0 of the first one.
// With the counts s_i of exposure i, its time t_i in seconds and the variance v_i:
//   s = sum a_i s_i t_0 / t_i,   a_i = (t_i^2 / v_i) / sum (t_k^2 / v_k),
//   variance t_0^2 / sum (t_k^2 / v_k),
// over the exposures that are not clipped there. v_i is the variance for the expected signal,
// t_i sum s_k / sum t_k, and not for the measured s_i: weights from the noise of the sample itself
// would favour low samples, a bias of one electron each.
//
// - An exposure is clipped at a sample if any of the 5 x 5 samples of the same phase around it is
//   marked as clipped. If only its own mark counted, samples near the clip level would contribute
//   only with negative noise, a bias of up to 0.4 standard deviations; with the 25 it is below
//   0.04.
// - Where all exposures are clipped, the sample and mark of the shortest one are taken.
// - An exposure does not contribute to samples expected below its floor_counts.
// - A defect in one exposure is a defect in the result.
// floor_counts is the lowest of the exposures in the same counts; part_of_exposure holds the a_i. A
// single exposure is returned unchanged. Throws std::invalid_argument without exposures, when their
// rectangles or filters differ, or for exposure_s <= 0.
CfaSamples merged_samples(const std::vector<CfaSamples>& exposures);

}  // namespace scattermeter::capture
