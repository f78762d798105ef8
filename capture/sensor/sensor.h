// Simulation of a sensor: from expected signal to stored codes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "capture/raw/raw_frame.h"
#include "capture/sensor/noise_model.h"

namespace scattermeter::capture {

struct SensorModel {
  SensorNoise noise;  // gain and read noise
  std::array<int, 4> black_counts = {64, 64, 64, 64};
  int white_counts = 4095;                // the converter clips here
  std::vector<std::uint16_t> tone_curve;  // decoded value per code; empty: identity
  bool noise_on = true;
  // Departure from linearity: x linear counts are recorded as x (1 + departure_at_white x / (white
  // - black)), with the lowest black of the phases. |departure_at_white| < 0.5.
  double departure_at_white = 0;
  double black_offset_counts = 0;  // black of this shot minus black_counts
};

// The stored codes of a frame with the expected signal `signal_counts` above black (width_px *
// height_px values, row by row, in counts, finite and not negative). Photon noise is Poisson in
// electrons (normal with the same mean and variance above 1000 electrons); the departure from
// linearity is applied; normal read noise and black are added; the sum is rounded, clipped to 0 ..
// white_counts and mapped to the nearest code of the tone curve. Without noise_on both kinds of
// noise are omitted. Every row has its own generator seeded by (seed, row), so the result does not
// depend on the number of threads. Throws std::invalid_argument for values out of these ranges.
std::vector<std::uint16_t> expose(const std::vector<float>& signal_counts, int width_px,
                                  int height_px, const SensorModel& sensor, std::uint64_t seed);

}  // namespace scattermeter::capture
