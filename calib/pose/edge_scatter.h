// How far pieces of an outline scatter beyond their noise.
#pragma once

#include <vector>

#include "calib/pose/edge_fit.h"

namespace scattermeter::calib {

struct EdgeScatter {
  double piece_std_px = 0;  // each piece's own, about the straight line of its edge
  double line_std_px = 0;   // of each end of a line, see EdgeFitOptions
};

// By moments (R. C. Paule, J. Mandel, "Consensus values and weighting factors", 1982), in two
// steps. (1) piece_std_px makes the squares about each line's own straight line what its freedom
// says. (2) line_std_px does the same for place and direction of all lines (two numbers each) about
// the fit of `model.free` under `model.prior`; its own scatters are not used. At least `floor_px`.
EdgeScatter edge_scatter(const std::vector<EdgePoint>& points, const CameraIntrinsics& intrinsics,
                         const Rigid3d& camera_from_world, const EdgeFitOptions& model,
                         double floor_px);

}  // namespace scattermeter::calib
