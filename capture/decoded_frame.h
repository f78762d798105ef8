// Stored codes as a raw reader delivers them, without the file.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/dng_writer.h"
#include "capture/raw_frame.h"

namespace scattermeter::capture {

// The frame that read_raw() makes of the file that write_dng() makes of the same arguments: codes
// through the linearization table, black, white and levels of the linear scale, exposure. Two
// things differ: make and model stay as given (LibRaw shortens them), and exposure_s and f_number
// are not rounded to the file's rationals. std::invalid_argument when the number of codes is not
// width_px * height_px, or for a code beyond the table.
RawFrame decoded_frame(int width_px, int height_px, const std::vector<std::uint16_t>& codes,
                       const DngMetadata& metadata);

}  // namespace scattermeter::capture
