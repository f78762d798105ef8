// The values that the tone curve of a raw file can produce.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scattermeter::capture {

// The decoded values of all codes that the file can hold, ascending and distinct; empty when the
// curve is the identity or does not contain all samples.
// - table: the decoder's table of the decoded value of each code. Decoders pad it beyond the curve
//   of the file: LibRaw repeats the last value for a DNG and continues with the identity for a NEF,
//   so a tail that is the identity is ignored.
// - bits: number of bits of a stored code, clamped to 1 .. 16: codes from 2^bits on cannot occur.
// - samples: the decoded samples. Some formats (Sony's) apply the table in a way of their own, so
//   the levels are returned only if every sample is one of them.
std::vector<std::uint16_t> curve_levels(std::span<const std::uint16_t> table, int bits,
                                        const std::vector<std::uint16_t>& samples);

}  // namespace scattermeter::capture
