// Comments for formats that hold colours instead of albedos.
#pragma once

#include <string>
#include <vector>

#include "apps/export/export_medium.h"
#include "core/material/subsurface_colour.h"

namespace scattermeter::apps {

// The source of the fit and, for each channel, the colour, the exact reflectance of an
// index-matched half-space, and sigma_a as the renderer will recover it from the colour. The
// albedos are those of the reduced material (g = 0).
std::vector<std::string> colour_notes(const ColourFit& fit, const MeasuredMaterial& material);

// The reduced albedo sigma_s' / sigma_t' of each channel.
std::array<double, 3> reduced_albedo(const MeasuredMaterial& material);

}  // namespace scattermeter::apps
