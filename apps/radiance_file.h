// The file that `calibrate radiance` writes and a rig's camera.radiance names.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "capture/radiance_correction.h"

namespace scattermeter::apps {

// How well one part of the calibration fitted, for `check`.
struct RadianceResidual {
  std::string what;
  double rms = 0, worst = 0, limit = 0;
  std::string unit;
};

// Mean of the samples of half an octave of signal, for pictures.
struct RadiancePoint {
  double counts = 0;
  double value = 0;
  double std = 0;  // of the mean, by the scatter of the samples
};

struct RadianceCalibration {
  capture::RadianceCorrection correction;
  // Counts per (W/(mm^2 sr)) and second, for the LED intensities of the rig; its standard deviation
  // holds albedo, LED and what the corrections above leave.
  std::optional<std::array<double, 3>> responsivity;
  double responsivity_relative_std = 0;
  // Of the departure at its knots, per colour; row by row.
  std::array<std::vector<double>, kRgb> response_covariance;
  std::array<double, kRgb> gain_std_e_per_count{};
  std::array<double, kRgb> read_noise_std_counts{};
  // What the fits were held against; files of older versions have none. Recorded counts over light
  // less one, of all colours as they share the curve; variance in counts^2 of each colour.
  std::vector<RadiancePoint> linearity;
  std::array<std::vector<RadiancePoint>, kRgb> noise;
  std::vector<RadianceResidual> residuals;
  std::vector<std::string> notes;
};

// Means over half octaves of counts; bins of fewer than `least` samples are left out. Preconditions
// (std::invalid_argument): lists of one length; counts not above 0 are passed over.
std::vector<RadiancePoint> radiance_points(const std::vector<double>& counts,
                                           const std::vector<double>& values,
                                           std::size_t least = 4);

// YAML, every number with the digits that a double needs to come back.
std::string radiance_file_text(const RadianceCalibration& calibration);

// Throws InputError with file, line, field and value.
RadianceCalibration read_radiance_file(const std::string& path);

}  // namespace scattermeter::apps
