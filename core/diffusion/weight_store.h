// Where W is kept between programs.
#pragma once

#include <vector>

#include "core/base/kept_store.h"
#include "core/diffusion/distance_weights.h"

namespace scattermeter {

// The elements of what is kept must be representable in single precision, as those of
// smooth_weights() are.
using WeightStore = KeptStore<WeightMatrix>;

// smooth_weights(), from the store if they are there; else computed and kept. They are named by all
// that they follow from: sites, lit triangles, knots and options. store: may be null.
WeightMatrix smooth_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                            const DistanceKnots& knots, const PairSumOptions& options,
                            WeightStore* store);

}  // namespace scattermeter
