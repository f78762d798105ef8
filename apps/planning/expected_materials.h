// The materials that a plan expects: those of the rig, or ranges of coefficients.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "apps/rig/rig.h"
#include "core/material/medium.h"

namespace scattermeter::apps {

// Of a coefficient, 1/mm; 0 <= low <= high.
struct ExpectedRange {
  double low = 0;
  double high = 0;
};

// As Truth::materials: R, G, B by name.
using TruthMaterials = std::map<std::string, std::array<Medium, 3>>;

// The media of every material of the rig's shots: first in the middle of the ranges (geometric for
// sigma_s', arithmetic for sigma_a, which may start at 0), then, unless both ranges are empty, at
// each of their corners. A coefficient without a range is that of the rig's truth.materials. Throws
// std::invalid_argument for an invalid range and InputError for a material that is neither in
// truth.materials nor given by both ranges.
std::vector<TruthMaterials> expected_materials(const Rig& rig,
                                               const std::optional<ExpectedRange>& sigma_s_prime,
                                               const std::optional<ExpectedRange>& sigma_a);

}  // namespace scattermeter::apps
