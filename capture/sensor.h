// A simulated sensor: from expected signal to stored codes.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "capture/noise_model.h"
#include "capture/raw_frame.h"

namespace scattermeter::capture {

struct SensorModel {
  SensorNoise noise;  // gain and read noise
  std::array<int, 4> black_counts = {64, 64, 64, 64};
  int white_counts = 4095;                // the converter's top; clips there
  std::vector<std::uint16_t> tone_curve;  // decoded value per code; empty: identity
  bool noise_on = true;
  // The counts of x counts' worth of light are x (1 + departure_at_white x / (white - black)); to
  // the phase with the lowest black. |departure| < 0.5.
  double departure_at_white = 0;
  double black_offset_counts = 0;  // black of this shot over black_counts
};

// Stored codes of a frame whose expected signal above black is `signal_counts` (row by row,
// width_px * height_px, in counts, >= 0 and finite).
// Photon noise: Poisson in electrons (normal with the same mean and variance above 1000 electrons);
// the departure; read noise: normal; then black is added, the sum rounded to an integer, clipped to
// 0 .. white_counts, and mapped to the nearest code of the tone curve. With noise off only the
// latter. Every row draws from its own generator, seeded by (seed, row): the result is the same for
// any number of threads.
std::vector<std::uint16_t> expose(const std::vector<float>& signal_counts, int width_px,
                                  int height_px, const SensorModel& sensor, std::uint64_t seed);

}  // namespace scattermeter::capture
