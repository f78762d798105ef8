// Linear samples of a raw frame, corrected by a radiance calibration.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "capture/raw/raw_frame.h"
#include "capture/sensor/radiance_correction.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::capture {

struct CorrectedSamples {
  CfaSamples samples;  // exposure_s: the true one
  // Errors that all samples of the shot share; not part of their variances.
  double black_std_counts = 0;
  // Mean of the frame in counts for each colour; glare is a share of it.
  std::array<double, kRgb> frame_mean_counts{};
  double exposure_relative_std = 0;
};

// The samples of a rectangle of the frame, in px, converted to counts at the frame centre: black
// and dark current are subtracted, the response is linearised, glare (a share of the frame mean of
// the colour, in which clipped samples have their clip level) is subtracted, and vignetting is
// divided out. The variances are those of the noise model with gain and read noise of the
// calibration, propagated through the same steps. Defect pixels are marked kSampleDefect; samples
// are marked as clipped by clip_levels() and when they lie more than 5 % beyond the last knot of
// the response. frame_mean_counts replaces the mean of the frame when a better one is known: a long
// exposure loses the brightness of its clipped samples, a shorter one of the same scene does not.
// Throws std::invalid_argument for a rectangle that is not inside the frame, without an exposure
// time, and for a frame to which the correction does not apply (see correction_problem()).
CorrectedSamples corrected_samples(
    const RawFrame& frame, const RadianceCorrection& correction, int x0, int y0, int width,
    int height, const std::optional<std::array<double, kRgb>>& frame_mean_counts = std::nullopt);

// Why the calibration does not apply to the frame, with both values; empty if it does. ISO and
// aperture are compared only if the file states them.
std::string correction_problem(const RawFrame& frame, const RadianceCorrection& correction);

// The mean of the linearised counts above black over the frame, for each colour, without defect
// pixels.
std::array<double, kRgb> frame_mean_counts(const RawFrame& frame,
                                           const RadianceCorrection& correction);

}  // namespace scattermeter::capture
