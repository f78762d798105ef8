// The blur of a picture, from that of the edges in it.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace scattermeter::calib {

struct EdgeBlur {
  Eigen::Vector2d outward;  // unit, px axes
  double blur_px = 0;       // standard deviation across the edge
};

// Standard deviation of the blur, px: the median over the edges, or, of a picture that moved during
// its exposure, that along the motion. Across an edge with normal at the angle t, such a picture is
// blurred by b^2 = a + c cos 2t + d sin 2t; it counts as moved where these terms explain the
// differences between the edges with an F ratio that chance reaches once in some thousand pictures.
// Domain: at least one edge (std::invalid_argument).
double picture_blur_px(const std::vector<EdgeBlur>& edges);

}  // namespace scattermeter::calib
