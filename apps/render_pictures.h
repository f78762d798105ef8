// Rendered radiance as pictures for a screen.
#pragma once

#include <string>
#include <vector>

#include "apps/picture.h"
#include "apps/render.h"

namespace scattermeter::apps {

// The radiance that is shown as white, W/(mm^2 sr): what the largest channel of 1 pixel in 500 of
// those that show an object exceeds, over all pictures, so that they can be held against each
// other. 1 where nothing is lit.
double white_radiance(const Rendering& rendering);

// What a screen wants for a linear value, 0 .. 255: cut to 0 .. 1, IEC 61966-2-1.
std::uint8_t srgb_byte(double linear);

// radiance / white by srgb_byte(); no other tone curve, the camera's R, G, B as those of the
// screen.
Picture srgb_picture(const ColourRadiance& radiance, double white);

// Scenes as rows, materials as columns, each with its name; as wide as max_width_px where that is
// enough for 80 px a picture.
Picture contact_sheet(const Rendering& rendering, const std::vector<std::string>& materials,
                      double white, int max_width_px = 1600);

}  // namespace scattermeter::apps
