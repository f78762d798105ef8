// From a decoded raw frame to linear samples, with a radiance calibration.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "capture/radiance_correction.h"
#include "capture/raw_frame.h"
#include "core/cfa_samples.h"

namespace scattermeter::capture {

struct CorrectedSamples {
  CfaSamples samples;  // exposure_s: the true one
  // What all samples of the shot share, not in their variances.
  double black_std_counts = 0;
  // Mean of the frame's counts per colour, of which glare is a share.
  std::array<double, kRgb> frame_mean_counts{};
  double exposure_relative_std = 0;
};

// A rectangle of the frame as light in counts of the frame's centre: black and dark current of the
// calibration subtracted, departure from linearity undone, glare (a share of the frame's mean of
// the colour; a clipped sample counts with its level) subtracted, vignetting divided out.
// Variances: noise model with the calibration's gain and read noise, taken through the same.
// Defect pixels are marked kSampleDefect; clipped is what clip_levels() says, and what lies more
// than 5 % beyond the last knot of the response curve.
// frame_mean_counts: in place of the frame's own mean, where another one is known better: the
// clipped samples of a long exposure hide how bright they are, a shorter one of the scene does not.
// std::invalid_argument: the rectangle leaves the frame, no exposure time, or a frame whose size,
// ISO or aperture is not the calibration's (see correction_problem()).
CorrectedSamples corrected_samples(
    const RawFrame& frame, const RadianceCorrection& correction, int x0, int y0, int width,
    int height, const std::optional<std::array<double, kRgb>>& frame_mean_counts = std::nullopt);

// Why the calibration does not hold for the frame, with both values; empty: it does. ISO and
// aperture that a file does not state are not compared.
std::string correction_problem(const RawFrame& frame, const RadianceCorrection& correction);

// Mean over the frame of the counts above black per colour, made linear; defect pixels left out.
std::array<double, kRgb> frame_mean_counts(const RawFrame& frame,
                                           const RadianceCorrection& correction);

}  // namespace scattermeter::capture
