// Where a straight edge lies in a raw, to a small part of a pixel.
#pragma once

#include <optional>

#include <Eigen/Core>

#include "core/camera/cfa_samples.h"

namespace scattermeter::calib {

struct EdgeStripOptions {
  double half_length_px = 4.0;  // of the strip, along the edge
  double half_width_px = 5.0;   // across it, on each side of where it is looked for
  double search_px = 2.0;       // the edge is looked for this far to each side; the strip is wider
                                // by that much
  double max_blur_px = 3.0;
  std::optional<double> blur_px;  // known, > 0: not fitted
  double min_snr = 8.0;           // of the step; below, the edge is not found
  bool both_bright = false;  // there is light on both sides (a crease), and either is the brighter
};

struct EdgeStrip {
  bool found = false;
  double offset_px = 0;  // of the edge from where it was looked for, along `outward`
  double std_px = 0;     // of that: photon and read noise, times the misfit where that is above 1
  double snr = 0;        // of the step, over all channels
  double blur_px = 0;    // standard deviation of the blur across the edge, the pixel's box apart
  double reduced_chi2 = 0;
};

// Least squares over all samples of a strip that no other strip need share, each channel with its
// own brightness, all with one edge:
//   signal = b + a_0 S_0(t) + a_1 S_1(t) + a_2 S_2(t) [+ c t],   t = offset - s,
// s the distance of the sample's centre along `outward`, S_k as in EdgeShape with the lens's blur,
// fitted. a_1 and a_2 model the glow that falls off towards the edge of a translucent body; without
// them it moves the edge by some hundredths of a pixel. Each sample counts once, in one channel:
// nothing is interpolated. Weights from the fitted signal, not from the noisy sample.
//
// Not found: outside the samples, a clipped sample in the strip, step below min_snr or of the wrong
// sign (the body is the brighter side unless both_bright), an end of the search reached, too few
// samples. `outward` is a unit vector; else std::invalid_argument.
EdgeStrip locate_edge(const CfaSamples& samples, const Eigen::Vector2d& at_px,
                      const Eigen::Vector2d& outward, const EdgeStripOptions& options = {});

}  // namespace scattermeter::calib
