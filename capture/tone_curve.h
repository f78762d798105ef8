// The tone curve of a 12-bit lossy compressed NEF.
#pragma once

#include <cstdint>
#include <vector>

namespace scattermeter::capture {

// Decoded value of each of the 683 codes that Nikon's lossy 12-bit compression keeps: steps of one
// count in the deep shadows, then steps that grow about as the square root of the value (as photon
// noise does). Strictly increasing, starts at 0, ends at 3880, the top that compressed NEFs show.
std::vector<std::uint16_t> nef_lossy_curve();

// Code whose decoded value is nearest to `value_counts` (the lower code on a tie).
// Precondition: `curve` ascending and not empty.
std::uint16_t nearest_code(const std::vector<std::uint16_t>& curve, double value_counts);

}  // namespace scattermeter::capture
