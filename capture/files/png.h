// Encoding of pictures as PNG.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scattermeter::capture {

// The bytes of a PNG file, with a palette where there are at most 256 colours. rgb: width_px x
// height_px pixels of sRGB, row by row. Throws
// std::invalid_argument when there are no pixels or another number of them, std::runtime_error when
// libpng fails.
std::vector<std::uint8_t> png_of_rgb(int width_px, int height_px,
                                     std::span<const std::uint8_t> rgb);

}  // namespace scattermeter::capture
