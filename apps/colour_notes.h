// What a file with colours in place of albedos says of them.
#pragma once

#include <string>
#include <vector>

#include "apps/export_medium.h"
#include "apps/subsurface_colour.h"

namespace scattermeter::apps {

// The fit's source and, for each channel, the colour beside the exact reflectance of an
// index-matched half-space, and sigma_a as the renderer will read it beside the measured one.
// The albedos are those of the reduced material (g = 0).
std::vector<std::string> colour_notes(const ColourFit& fit, const MeasuredMaterial& material);

// sigma_s' / sigma_t' of each channel.
std::array<double, 3> reduced_albedo(const MeasuredMaterial& material);

}  // namespace scattermeter::apps
