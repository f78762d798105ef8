// Whether the exposures of a bracket agree about the light.
#pragma once

#include <vector>

#include "core/cfa_samples.h"

namespace scattermeter::capture {

struct ExposureDeparture {
  // ln of this exposure's light over that of the others, by their times; NaN where no sample is in
  // this and another one.
  double log_ratio = 0;
  double noise_std = 0;    // of that, by the samples' variances
  double mean_counts = 0;  // of this exposure's samples in the sums: a count of black is 1 / this
};

// Of each exposure. Over the samples in which it and at least one other have a part of `merged` ==
// merged_samples(exposures): sum of its counts / t against sum over samples of (sum of the others'
// counts / sum of their t). Precondition (std::invalid_argument): parts for each exposure.
std::vector<ExposureDeparture> exposure_departures(const std::vector<CfaSamples>& exposures,
                                                   const CfaSamples& merged);

}  // namespace scattermeter::capture
