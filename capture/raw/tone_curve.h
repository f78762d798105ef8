// The tone curve of a 12-bit lossy compressed NEF.
#pragma once

#include <cstdint>
#include <vector>

namespace scattermeter::capture {

// The decoded value of each of the 683 codes of Nikon's lossy 12-bit compression: steps of one
// count in the deep shadows, then steps that grow with the square root of the value, as photon
// noise does. Strictly increasing from 0 to 3880, the largest value found in compressed NEFs.
std::vector<std::uint16_t> nef_lossy_curve();

// The code whose decoded value is nearest to `value_counts`; the lower of two equally near ones.
// Precondition: `curve` is ascending and not empty.
std::uint16_t nearest_code(const std::vector<std::uint16_t>& curve, double value_counts);

}  // namespace scattermeter::capture
