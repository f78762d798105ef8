// Decoding of stored codes without a file.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/raw/raw_frame.h"
#include "capture/raw/raw_metadata.h"

namespace scattermeter::capture {

// The frame that read_raw() returns for a file that write_dng() or write_nef() writes from the same
// arguments, with the linearization table applied to the codes. Two things differ: make and model
// stay as given (LibRaw shortens them), and exposure_s and f_number are not rounded to the
// rationals of the file. Throws std::invalid_argument when the number of codes is not width_px *
// height_px, or for a code beyond the table.
RawFrame decoded_frame(int width_px, int height_px, const std::vector<std::uint16_t>& codes,
                       const RawMetadata& metadata);

}  // namespace scattermeter::capture
