// What a simulated camera does to a picture: a rig's truth.sensor.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "apps/yaml_field.h"

namespace scattermeter::apps {

struct TrueExposure {
  double stated_s = 0;  // in the file
  double true_s = 0;
  bool operator==(const TrueExposure&) const = default;
};

struct RigSensorTruth {
  std::array<std::vector<double>, 3>
      vignetting_radial;     // core/vignetting.h, about the frame's centre
  double veiling_glare = 0;  // every pixel gets this share of the frame's mean of its colour
  double hot_pixel_share = 0;
  double hot_pixel_counts_per_s = 0;  // of the median hot pixel; log-normal, factor e^0.5
  std::uint64_t hot_pixel_seed = 1;   // which pixels: the camera's, the same in every shot
  double dark_current_counts_per_s = 0;
  double black_drift_counts = 0;        // standard deviation of each shot's black level
  double non_linearity = 0;             // departure at the white level, see capture/sensor.h
  bool shutter_in_thirds = false;       // true times are 2^(k/3) s: 1/60 is 1/64, 1/50 is 1/50.8
  std::vector<TrueExposure> exposures;  // for times of their own; come first
  bool operator==(const RigSensorTruth&) const = default;
};

// Throws InputError with file, line, field and value.
RigSensorTruth read_sensor_truth(const YamlField& field);

}  // namespace scattermeter::apps
