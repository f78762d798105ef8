// Noise of a shot as a function of its signal, measured from the shot itself.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/camera/cfa_samples.h"
#include "core/view/sample_map.h"

namespace scattermeter::capture {

// Statistics of samples with about the same signal.
struct NoisePoint {
  double mean_counts = 0;  // above black
  double variance_counts2 = 0;
  double relative_std = 0;   // standard deviation of a variance by so many triples, normal noise
  double model_counts2 = 0;  // mean of the variances that the samples have
  std::size_t triples = 0;
};

// The noise of each channel in half octaves of the mean, from 1 count on. The variance is a sixth
// of the mean squared second difference of three neighbouring samples of one filter phase on one
// row of the map, which a linear change of the signal does not affect. Clipped samples are not
// used. Throws std::invalid_argument when the rectangles of samples and map differ.
std::array<std::vector<NoisePoint>, kRgb> noise_curve(const CfaSamples& samples,
                                                      const SampleMap& map);

}  // namespace scattermeter::capture
