// Vignetting from the mean of flats.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "calib/frame_blocks.h"
#include "core/vignetting.h"

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
  std::size_t n_radial = 0, n_map = 0;  // what cross-validation chose
  // Of each colour's factors: radial, then map.
  std::array<Eigen::MatrixXd, kRgb> covariance;
  double rms_std = 0;         // standard deviation of a share, rms over the frame and the colours
  double corner_std = 0;      // the largest in a corner
  double rms = 0, worst = 0;  // residuals of the blocks, relative
  double reduced_chi2 = 0;
  bool ok = false;  // false: too few blocks of a colour
};

// light = A(colour) V(block), V averaged over the block's own samples; least squares per colour,
// centre and radius the frame's. The number of radial terms (0 .. 4) and whether the four terms
// that are not round take part is chosen over five folds of blocks: the fewest terms whose error of
// prediction lies within one standard error of the best (Hastie, Tibshirani, Friedman, Elements of
// Statistical Learning, 7.10). A flat field that is itself uneven is taken for vignetting.
VignettingFit fit_vignetting(const std::vector<FlatLight>& blocks, int width_px, int height_px);

// Standard deviation of a share at a place.
double share_std(const VignettingFit& fit, double x_px, double y_px, std::size_t colour);

}  // namespace scattermeter::calib
