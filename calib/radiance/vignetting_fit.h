// Vignetting from the mean of flats.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "calib/radiance/frame_blocks.h"
#include "core/camera/vignetting.h"

namespace scattermeter::calib {

// Light of one block, in any unit.
struct FlatLight {
  Block block;
  std::size_t colour = 0;
  double light = 0;     // > 0
  double variance = 0;  // > 0, of this block alone
  // Relative changes by what blocks share: one for each of some independent errors of deviation 1,
  // the same in number for all blocks; may be empty. Widens the covariance.
  Eigen::VectorXd shared = {};
};

struct VignettingFit {
  Vignetting vignetting;
  // Of each colour's factors: four radial ones, then map's four.
  std::array<Eigen::MatrixXd, kRgb> covariance;
  double rms_std = 0;         // standard deviation of a share, rms over the frame and the colours
  double corner_std = 0;      // the largest in a corner
  double rms = 0, worst = 0;  // residuals of the blocks, relative
  double reduced_chi2 = 0;
  bool ok = false;  // false: too few blocks of a colour
};

// light = A(colour) V(block), V averaged over the block's own samples; least squares per colour,
// centre and radius the frame's. All eight terms always take part: where the data chose the terms,
// the choice scattered from one calibration to the next by more than the covariance of the terms
// chosen tells (a quarter of the deviation, over the frame), and what the terms too many cost is a
// hundredth of what flats resolve. A flat field that is itself uneven is taken for vignetting.
VignettingFit fit_vignetting(const std::vector<FlatLight>& blocks, int width_px, int height_px);

// Standard deviation of a share at a place.
double share_std(const VignettingFit& fit, double x_px, double y_px, std::size_t colour);

}  // namespace scattermeter::calib
