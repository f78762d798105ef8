// Tone mapping of rendered radiance to pictures.
#pragma once

#include <string>
#include <vector>

#include "apps/report/picture.h"
#include "apps/simulation/render.h"

namespace scattermeter::apps {

// The radiance shown as white, W/(mm^2 sr), common to all pictures so that they can be compared:
// the largest channel exceeds it in 1 of 500 of the pixels that show an object. 1 if nothing is
// lit.
double white_radiance(const Rendering& rendering);

// The sRGB code (IEC 61966-2-1) of a linear value, clamped to 0 .. 1.
std::uint8_t srgb_byte(double linear);

// radiance / white by srgb_byte(), without another tone curve. The camera's R, G, B are shown as
// those of the screen.
Picture srgb_picture(const ColourRadiance& radiance, double white);

// All pictures with scenes as rows and materials as columns, labelled with their names. At most
// max_width_px wide unless the pictures would be narrower than 80 px.
Picture contact_sheet(const Rendering& rendering, const std::vector<std::string>& materials,
                      double white, int max_width_px = 1600);

}  // namespace scattermeter::apps
