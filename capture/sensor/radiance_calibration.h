// Radiance calibration of a camera: the correction of its frames, its scale, and the residuals of
// each part of the fit.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "capture/sensor/radiance_correction.h"

namespace scattermeter::capture {

// Residuals of one part of the calibration.
struct RadianceResidual {
  std::string what;
  double rms = 0, worst = 0, limit = 0;  // in `unit`; the limit applies to the rms
  std::string unit;
};

// Mean of the samples within half an octave of signal, for plots.
struct RadiancePoint {
  double counts = 0;
  double value = 0;
  double std = 0;  // of the mean, from the scatter of the samples
};

struct RadianceCalibration {
  RadianceCorrection correction;
  // In counts per (W/(mm^2 sr)) and second for R, G, B; absent without a white reference. The
  // relative standard deviation includes those of the albedo, the LED and the correction.
  std::optional<std::array<double, 3>> responsivity;
  double responsivity_relative_std = 0;
  // Covariance of the departure of the response at its knots for each colour, row by row.
  std::array<std::vector<double>, kRgb> response_covariance;
  std::array<double, kRgb> gain_std_e_per_count{};
  std::array<double, kRgb> read_noise_std_counts{};
  // Measured means behind the fits; empty in files of older versions. Linearity: recorded over
  // linear counts minus one, for all colours together, as they share the curve. Noise: variance in
  // counts^2 of each colour.
  std::vector<RadiancePoint> linearity;
  std::array<std::vector<RadiancePoint>, kRgb> noise;
  std::vector<RadianceResidual> residuals;
  std::vector<std::string> notes;
};

// The means of `values` over half octaves of `counts`, without bins of fewer than `min_samples`
// samples and without samples whose counts are not positive or whose value is not finite. Throws
// std::invalid_argument for lists of different lengths.
std::vector<RadiancePoint> radiance_points(const std::vector<double>& counts,
                                           const std::vector<double>& values,
                                           std::size_t min_samples = 4);

}  // namespace scattermeter::capture
