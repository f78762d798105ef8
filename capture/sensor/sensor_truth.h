// True errors of a simulated sensor, and the kind of its files.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "capture/raw/raw_metadata.h"

namespace scattermeter::capture {

struct TrueExposure {
  double stated_s = 0;  // as written to the file
  double true_s = 0;
  bool operator==(const TrueExposure&) const = default;
};

struct SensorTruth {
  std::array<std::vector<double>, 3>
      vignetting_radial;     // core/camera/vignetting.h, about the frame centre
  double veiling_glare = 0;  // share of the frame mean of its colour added to every pixel
  double hot_pixel_share = 0;
  double hot_pixel_counts_per_s = 0;  // of the median hot pixel; log-normal, factor e^0.5
  std::uint64_t hot_pixel_seed = 1;   // selects the pixels, the same in every shot of the camera
  double dark_current_counts_per_s = 0;
  double black_drift_counts = 0;   // standard deviation of each shot's black level
  double non_linearity = 0;        // departure at the white level, see capture/sensor/sensor.h
  bool shutter_in_thirds = false;  // true times are 2^(k/3) s: 1/60 is 1/64, 1/50 is 1/50.8
  RawFormat format = RawFormat::kDng;
  std::vector<TrueExposure> exposures;  // true times of single settings; take precedence
  bool operator==(const SensorTruth&) const = default;
};

}  // namespace scattermeter::capture
