// Listed defects of a frame, for looks at it as a picture.
#pragma once

#include <cstddef>
#include <vector>

#include "capture/raw/raw_frame.h"

namespace scattermeter::capture {

// Replaces the samples at `defect_pixels` (ascending; y * width_px + x, as in RadianceCorrection)
// by the mean of the nearest four of their filter that are not listed themselves; those without any
// stay. What is measured leaves them out (capture/sensor/corrected_samples.h): outlines and the
// background would take them for light.
void mend_defects(const std::vector<std::size_t>& defect_pixels, RawFrame& frame);

}  // namespace scattermeter::capture
