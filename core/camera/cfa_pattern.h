// The colour-filter array of a sensor.
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace scattermeter {

// Colour channels. The two greens of a Bayer sensor are one channel; as phases they remain
// distinct.
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

}  // namespace scattermeter
