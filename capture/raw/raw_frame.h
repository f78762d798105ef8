// The colour-filter-array samples of one decoded raw file.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/camera/cfa_pattern.h"

namespace scattermeter::capture {

// Samples are counts on the linear scale: the decoder has inverted the tone curve of the file;
// black is not subtracted, and nothing is scaled, interpolated or clipped.
struct RawFrame {
  int width_px = 0;  // of the active area
  int height_px = 0;
  std::vector<std::uint16_t> samples;  // height_px * width_px, row by row, in counts
  CfaPattern cfa;
  std::array<double, 4> black_counts{};  // for each phase, indexed as CfaPattern::phase
  double white_counts = 0;               // the file's white level (LibRaw's `maximum`), in counts
  // Decoded values that the tone curve of the file can produce, ascending and distinct; empty when
  // the curve is the identity, so that every integer is possible.
  std::vector<std::uint16_t> curve_levels;
  double exposure_s = 0;  // 0: not in the file
  double iso = 0;         // 0: not in the file
  double f_number = 0;    // 0: not in the file
  std::string make;       // as LibRaw normalises it
  std::string model;
  // Corner of the active area on the sensor, which has masked borders outside it.
  int left_margin_px = 0;
  int top_margin_px = 0;

  std::uint16_t at(int x, int y) const {
    return samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                   static_cast<std::size_t>(x)];
  }
};

// Whether two values of ISO or aperture, where both are known, are of different settings.
inline bool settings_differ(double a, double b) {
  return a > 0.0 && b > 0.0 && std::abs(a - b) > 1e-3 * b;
}

}  // namespace scattermeter::capture
