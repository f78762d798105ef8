// The noise of a shot against its light, as the shot itself shows it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/cfa_samples.h"
#include "core/sample_map.h"

namespace scattermeter::capture {

// Samples of about the same light.
struct NoisePoint {
  double mean_counts = 0;  // above black
  double variance_counts2 = 0;
  double variance_std_counts2 = 0;  // of that, from the number of samples, for normal noise
  double model_counts2 = 0;         // the samples' own variances
  std::size_t triples = 0;
};

// By channel, in half octaves of the mean from 1 count on.
// The variance is a sixth of the mean squared second difference of three neighbouring samples of
// one filter phase on one row of the map, which is free of the light's slope. Clipped samples take
// no part. Precondition (std::invalid_argument): the rectangles agree.
std::array<std::vector<NoisePoint>, kRgb> noise_curve(const CfaSamples& samples,
                                                      const SampleMap& map);

}  // namespace scattermeter::capture
