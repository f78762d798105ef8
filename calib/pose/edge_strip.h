// Location of a straight edge in a raw image to a small fraction of a pixel.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/camera/cfa_samples.h"

namespace scattermeter::calib {

struct EdgeStripOptions {
  double half_length_px = 4.0;  // of the strip, along the edge
  double half_width_px = 5.0;   // across the edge, on each side of its expected position
  double search_px = 2.0;       // search range to each side, by which the strip is widened
  double max_blur_px = 3.0;
  std::optional<double> blur_px;  // > 0: known and not fitted
  double min_snr = 8.0;           // of the step; the edge is not found below this
  bool both_bright = false;       // both sides are bright (a crease), and either may be brighter
};

struct EdgeStrip {
  bool found = false;
  double offset_px = 0;  // of the edge from its expected position, along `outward`
  double std_px = 0;     // of that: photon and read noise, times the misfit if above 1
  double snr = 0;        // of the step, over all channels
  double blur_px = 0;    // standard deviation of the blur across the edge, without the pixel's box
  double reduced_chi2 = 0;
};

// Least squares over all samples of a strip (adjacent strips have no samples in common), with
// separate brightnesses for each channel but a common edge:
//   signal = b + a_0 S_0(t) + a_1 S_1(t) + a_2 S_2(t) [+ c t],   t = offset - s,
// with s the distance of the sample's centre along `outward` and S_k as in EdgeShape with the
// fitted blur of the lens. a_1 and a_2 model the scattered light that decreases towards the edge of
// a translucent body; without them it would shift the edge by some hundredths of a pixel. Each
// sample counts once, in one channel: nothing is interpolated. Weights are derived from the fitted
// signal, not from the noisy sample.
//
// The edge is not found if the strip leaves the samples, contains a clipped sample or has too few
// samples, if the step is below min_snr or of the wrong sign (the body is the brighter side unless
// both_bright), or if the fit reaches an end of the search range. Throws std::invalid_argument
// unless `outward` is a unit vector.
EdgeStrip locate_edge(const CfaSamples& samples, const Eigen::Vector2d& at_px,
                      const Eigen::Vector2d& outward, const EdgeStripOptions& options = {});

}  // namespace scattermeter::calib
