// Which values a raw file's tone curve can produce.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace scattermeter::capture {

// Decoded values, ascending and without repeats, of the codes that the file can hold; empty when
// the curve is the identity, or when it does not explain the samples.
//   table    the decoder's table, decoded value per code. Past the curve that stands in the file a
//            decoder fills it up: LibRaw repeats the last value in a DNG and counts on as the
//            identity in a NEF, so an identity tail is left out.
//   bits     of a stored code, 1 .. 16 (clamped): codes from 2^bits on cannot occur.
//   samples  the decoded samples. Some formats (Sony's) run through the table in a way of their
//   own,
//            so the levels count only if every sample is one of them.
std::vector<std::uint16_t> curve_levels(std::span<const std::uint16_t> table, int bits,
                                        const std::vector<std::uint16_t>& samples);

}  // namespace scattermeter::capture
