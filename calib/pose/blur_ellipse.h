// Blur of a picture from the blur across edges of several directions.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter::calib {

struct EdgeBlur {
  Eigen::Vector2d normal;  // across the edge, unit vector in the picture
  double blur_px = 0;      // standard deviation along it
};

// The standard deviation along the direction in which the picture is blurred most, px: across an
// edge with normal n the variance is n^T B n, of which B is fitted with the least sum of absolute
// errors, since some edges are no straight steps. B is drawn to a blur that is the same in all
// directions by as much as four edges weigh. 0 without edges.
double widest_blur_px(const std::vector<EdgeBlur>& edges);

}  // namespace scattermeter::calib
