// Photon transfer: gain and read noise from the increase of the noise with the light.
#pragma once

#include <vector>

namespace scattermeter::calib {

// Noise of one block at one level (calib/radiance/frame_blocks.h), or of dark frames (counts 0).
struct NoisePoint {
  double counts = 0;                // light, made linear
  double variance_counts2 = 0;      // of a sample, made linear
  double quantisation_counts2 = 0;  // part of this from rounding: step^2 / 12
  double degrees_of_freedom = 0;
};

struct PhotonTransfer {
  double gain_e_per_count = 0;
  double gain_std = 0;
  double read_noise_counts = 0;
  double read_noise_std = 0;
  double reduced_chi2 = 0;  // of the points; above 1 the stds are widened
  double worst_sigma = 0;   // largest residual of a point over its standard deviation
  bool ok = false;          // false: the noise does not increase with the light, or too few points
};

// variance = counts / gain + read_noise^2 + quantisation: photon transfer (Janesick, Photon
// Transfer, SPIE 2007, ch. 5). Weighted least squares; a point's weight is its degrees of freedom
// over twice the square of the variance that the fit predicts, so that no point gets more weight
// because it happens to scatter less. Points with less than two degrees of freedom are left out.
// Needs three points.
PhotonTransfer fit_photon_transfer(const std::vector<NoisePoint>& points);

}  // namespace scattermeter::calib
