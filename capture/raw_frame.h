// The colour-filter-array samples of one shot, as the sensor delivered them.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace scattermeter::capture {

// Colour channels. A Bayer sensor's two greens are one channel here; they keep apart as phases.
enum class Channel : std::uint8_t { kRed = 0, kGreen = 1, kBlue = 2 };
inline constexpr int kChannels = 3;

// 2 x 2 colour filter array. phase[2 * (y & 1) + (x & 1)] is the channel of sample (x, y) of the
// active area (x to the right, y down, from 0).
struct CfaPattern {
  std::array<Channel, 4> phase = {Channel::kRed, Channel::kGreen, Channel::kGreen, Channel::kBlue};
  Channel at(int x, int y) const {
    return phase[2U * (static_cast<unsigned>(y) & 1U) + (static_cast<unsigned>(x) & 1U)];
  }
  bool operator==(const CfaPattern&) const = default;
};

// "RGGB", "GRBG", "GBRG" or "BGGR"; std::invalid_argument for any other text.
CfaPattern cfa_pattern_from_name(const std::string& name);
std::string cfa_pattern_name(const CfaPattern& pattern);

// One decoded raw file. Samples are counts of the linear scale: the file's tone curve has been
// undone by the decoder, black has not been subtracted, nothing has been scaled, interpolated or
// clipped.
struct RawFrame {
  int width_px = 0;  // of the active area
  int height_px = 0;
  std::vector<std::uint16_t> samples;  // height_px * width_px, row by row, in counts
  CfaPattern cfa;
  std::array<double, 4> black_counts{};  // per phase, index as in CfaPattern::phase
  double white_counts = 0;               // the file's white level (LibRaw's `maximum`), in counts
  // Decoded values that the file's tone curve can produce, ascending, no repeats; empty when the
  // curve is the identity, so that every integer is possible.
  std::vector<std::uint16_t> curve_levels;
  double exposure_s = 0;  // 0: not in the file
  double iso = 0;         // 0: not in the file
  double f_number = 0;    // 0: not in the file
  std::string make;       // as LibRaw normalises it
  std::string model;
  // Active area inside the whole sensor; the masked borders are outside it.
  int left_margin_px = 0;
  int top_margin_px = 0;

  std::uint16_t at(int x, int y) const {
    return samples[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_px) +
                   static_cast<std::size_t>(x)];
  }
};

}  // namespace scattermeter::capture
