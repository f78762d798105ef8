// A rectangle of a frame's pixels.
#pragma once

namespace scattermeter {

// Columns x0 to x0 + width - 1, rows y0 to y0 + height - 1; pixels are numbered from 0.
struct PixelRect {
  int x0 = 0, y0 = 0, width = 0, height = 0;
};

}  // namespace scattermeter
