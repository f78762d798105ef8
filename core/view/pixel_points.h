// Points spread over a pixel, for means over its area.
#pragma once

#include <Eigen/Core>

#include "core/view/sample_map.h"

namespace scattermeter {

// Directions inside a pixel, by the differences to its neighbours (exact without distortion).
class PixelPoints {
 public:
  // Precondition: the grid has at least two rows and columns.
  PixelPoints(const RayGrid& rays, int x, int y);

  // From the pixel's middle, in px, right and down: -0.5 .. 0.5. Not normalised.
  Eigen::Vector3d direction_at(double fx, double fy) const {
    return center_ + fx * per_x_ + fy * per_y_;
  }
  // Point i of n, a power of two from 16 to 64. No two share a row or a column of the pixel, so
  // that an edge along the grid is sampled at n offsets: for 64 points it appears within 1/128 px
  // of its true position (8 x 8 on a grid: 1/16 px).
  Eigen::Vector3d direction(int i, int n) const;
  double solid_angle_sr() const;

 private:
  Eigen::Vector3d center_, per_x_, per_y_;
};

}  // namespace scattermeter
