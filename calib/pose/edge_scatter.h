// Excess scatter of the pieces of an outline over their noise.
#pragma once

#include <vector>

#include "calib/pose/edge_fit.h"

namespace scattermeter::calib {

struct EdgeScatter {
  double piece_std_px = 0;  // of each piece about the straight line of its edge
  double line_std_px = 0;   // of each corner, see EdgeFitOptions
};

// Estimates the scatter by the method of moments (R. C. Paule, J. Mandel, "Consensus values and
// weighting factors", 1982) in two steps. (1) piece_std_px makes the sum of squares about a
// straight line fitted to each edge equal to its degrees of freedom. (2) line_std_px, at least
// `floor_px`, does the same for position and direction of all lines (two numbers each) about the
// fit of `model.free` under `model.prior`; the scatters in `model` are not used.
EdgeScatter edge_scatter(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                         const Rigid3d& camera_from_world, const EdgeFitOptions& model,
                         double floor_px);

}  // namespace scattermeter::calib
