// The EXIF directory of a written shot, byte by byte.
#pragma once

#include <cstdint>
#include <vector>

namespace scattermeter::capture {

struct Rational {
  std::uint32_t numerator;
  std::uint32_t denominator;
};

// The first convergent of the continued fraction of `value` that a double cannot tell from it (0.1
// is 1/10, 1.0/3 is 1/3), else the last one in 32-bit numbers. Domain: 2^-32 < value < 2^32, else
// std::invalid_argument.
Rational nearest_rational(double value);

// A little-endian directory with ExposureTime, FNumber and ISOSpeedRatings that stands at byte
// `offset` (even) of the file. (libtiff would pass the times through a float: 0.100000001 s.)
std::vector<std::uint8_t> exif_directory(std::uint32_t offset, double exposure_s, double f_number,
                                         int iso);

}  // namespace scattermeter::capture
