// What a written raw file says besides its samples.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/camera/cfa_pattern.h"

namespace scattermeter::capture {

enum class RawFormat : std::uint8_t {
  kDng,  // capture/raw/dng_writer.h
  kNef,  // capture/raw/nef_writer.h
};

struct RawMetadata {
  std::string make = "NIKON CORPORATION";
  std::string model = "NIKON D80";
  CfaPattern cfa;
  std::array<int, 4> black_counts = {0, 0, 0, 0};  // for each phase, on the linear scale
  int white_counts = 4095;                         // on the linear scale
  double exposure_s = 0.1;
  int iso = 100;
  double f_number = 8.0;
  // Decoded value of each stored code; empty: the codes are the counts.
  std::vector<std::uint16_t> linearization_table;
};

constexpr int kMaxRawSide_px = 65530;  // LibRaw counts rows and columns in 16 bits

// Throws std::invalid_argument, naming `caller`, unless a 12-bit raw file can hold the frame:
// - codes: width_px * height_px stored values, row by row, each at most 4095 and, with a table,
//   below its size. Sides are positive, even and at most kMaxRawSide_px.
// - metadata that the fields can hold: make and model not empty, a white level in 1 .. 65535 above
//   the black levels, positive exposure and f-number, an ISO speed in 1 .. 65534, a table of at
//   most 4096 entries.
void check_raw(const std::string& caller, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const RawMetadata& metadata);

}  // namespace scattermeter::capture
