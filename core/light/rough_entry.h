// Light that enters a body through a rough boundary.
#pragma once

#include <memory>

#include "core/light/entry_source.h"

namespace scattermeter {

// `arriving`: the light as it meets the surface, which is that of a source made for an eta of 1.
// What the boundary (RoughBoundary, surface_alpha > 0) reflects is left out, as sources of smooth
// bodies do.
std::unique_ptr<EntrySource> rough_entry(std::unique_ptr<EntrySource> arriving,
                                         double surface_alpha, double eta_int_over_ext);

}  // namespace scattermeter
