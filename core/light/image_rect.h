// A rectangle of an image.
#pragma once

namespace scattermeter {

// x right, y down, in pixels; (0, 0) is the upper left corner of the first pixel, whose centre is
// (0.5, 0.5).
struct ImageRect {
  double x0, y0, x1, y1;
};

}  // namespace scattermeter
