// Pictures as PNG.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scattermeter::apps {

// rgb: width x height pixels of sRGB, row by row. std::invalid_argument where that is not their
// number, or none; std::runtime_error where libpng refuses.
std::vector<std::uint8_t> png_of_rgb(int width_px, int height_px,
                                     std::span<const std::uint8_t> rgb);

}  // namespace scattermeter::apps
