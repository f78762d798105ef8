// Encoding of the EXIF directory of a written raw file.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/raw/ifd_bytes.h"

namespace scattermeter::capture {

// The first convergent of the continued fraction of `value` within 1e-15 of it, relatively (1/10
// for 0.1, 1/3 for 1.0 / 3), else the last one that fits in 32-bit numbers. Domain: 2^-32 < value <
// 2^32; throws std::invalid_argument outside.
Rational nearest_rational(double value);

// A directory with ExposureTime, FNumber, ISOSpeedRatings and, unless it is empty, MakerNote, to be
// written at byte `offset` (even) of the file. (libtiff would convert the times to float:
// 0.100000001 s.)
std::vector<std::uint8_t> exif_directory(std::uint32_t offset, double exposure_s, double f_number,
                                         int iso, ByteOrder order = ByteOrder::kLittleEndian,
                                         const std::vector<std::uint8_t>& maker_note = {});

}  // namespace scattermeter::capture
