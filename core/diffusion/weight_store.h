// Where W is kept between programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/diffusion/distance_weights.h"

namespace scattermeter {

// May be shared by several programs and used from several threads at once. Errors of the storage
// are its own: what cannot be read is not there, and what cannot be written is not kept.
class WeightStore {
 public:
  virtual ~WeightStore() = default;
  // Equal numbers, equal names.
  virtual std::string name(const std::vector<double>& numbers) const = 0;
  virtual std::optional<WeightMatrix> find(const std::string& name) = 0;
  // The elements must be representable in single precision, as those of smooth_weights() are.
  virtual void keep(const std::string& name, const WeightMatrix& weights) = 0;
};

// smooth_weights(), from the store if they are there; else computed and kept. They are named by all
// that they follow from: sites, lit triangles, knots and options. store: may be null.
WeightMatrix smooth_weights(const std::vector<ExitSite>& sites, const SourceCloud& sources,
                            const DistanceKnots& knots, const PairSumOptions& options,
                            WeightStore* store);

}  // namespace scattermeter
