// Fit of the vignetting to the light of the flats.
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
  double variance = 0;  // > 0, of independent errors
  // Relative changes due to errors that blocks have in common: one for each of a number of
  // independent errors of unit standard deviation, the same number for all blocks; may be empty.
  // They are added to the covariance.
  Eigen::VectorXd shared = {};
};

struct VignettingFit {
  Vignetting vignetting;
  // Of the factors of each colour: the four radial ones, then the four of the map.
  std::array<Eigen::MatrixXd, kRgb> covariance;
  double rms_std = 0;         // of the relative illumination, rms over frame and colours
  double corner_std = 0;      // the largest of the corners
  double rms = 0, worst = 0;  // residuals of the blocks, relative
  double reduced_chi2 = 0;
  bool ok = false;  // false: too few blocks of a colour
};

// light = A(colour) V(block), with V averaged over the samples of the block; least squares for each
// colour, with centre and radius of the frame. All eight terms are always fitted: with terms chosen
// by the data, the result varied from one calibration to the next by more than the covariance of
// the chosen terms (a quarter of the standard deviation, over the frame), while superfluous terms
// cost only a hundredth of what flats resolve. Unevenness of the flat field itself is taken for
// vignetting.
VignettingFit fit_vignetting(const std::vector<FlatLight>& blocks, int width_px, int height_px);

// Standard deviation of the relative illumination at a pixel.
double share_std(const VignettingFit& fit, double x_px, double y_px, std::size_t colour);

}  // namespace scattermeter::calib
