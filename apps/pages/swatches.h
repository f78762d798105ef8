// The colour of a measured material, on a page.
#pragma once

#include <array>
#include <vector>

#include "apps/instrument/measure.h"
#include "apps/pages/html_page.h"

namespace scattermeter::apps {

inline constexpr double kSwatchThickness_mm = 10.0;

// Reflectance of a plate of the estimated material with its standard deviation from that of both
// coefficients and their correlation (core/material/slab_reflectance.h).
Quantity plate_reflectance(const ChannelResult& result, double thickness_mm,
                           double background_albedo);

// Reflectances of a plate over black and over white and of a thick block, with the colours on a
// screen: the camera's R, G, B as those of sRGB, white light as its white (D65). Empty unless all
// three channels were measured.
Html swatches(const std::vector<const ChannelResult*>& channels);

}  // namespace scattermeter::apps
