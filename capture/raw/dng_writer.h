// Writing of synthetic raw files (DNG), the door to libtiff.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "capture/raw/raw_frame.h"

namespace scattermeter::capture {

struct DngMetadata {
  std::string make = "NIKON CORPORATION";
  std::string model = "NIKON D80";
  CfaPattern cfa;
  // On the linear scale, for each phase; written as one value if all are equal.
  std::array<int, 4> black_counts = {0, 0, 0, 0};
  int white_counts = 4095;  // on the linear scale
  double exposure_s = 0.1;
  int iso = 100;
  double f_number = 8.0;
  // Decoded value of each stored code (LinearizationTable); empty: the codes are the counts.
  std::vector<std::uint16_t> linearization_table;
};

// Writes a 12-bit packed, uncompressed CFA DNG (version 1.4) that LibRaw, dcraw and exiftool read.
// codes: width_px * height_px stored values, row by row, each at most 4095 and, with a table, below
// its size. Sides must be positive and even. LibRaw opens no frame smaller than 22 x 22. The file
// appears under `path` complete or not at all. Throws std::invalid_argument for arguments out of
// these ranges and for metadata that the fields cannot hold (a level out of range, an exposure that
// is not positive, an ISO speed outside 1 .. 65534), and InputError naming the file when it cannot
// be written.
void write_dng(const std::string& path, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const DngMetadata& metadata);

}  // namespace scattermeter::capture
