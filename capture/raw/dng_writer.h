// Writing of synthetic raw files (DNG).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/raw/raw_metadata.h"

namespace scattermeter::capture {

// Writes a 12-bit packed, uncompressed CFA DNG (version 1.4) that LibRaw, dcraw and exiftool read.
// Preconditions: those of check_raw(). LibRaw opens no frame smaller than 22 x 22. The black level
// is written as one value if those of all phases are equal. The file appears under `path` complete
// or not at all. Throws InputError naming the file when it cannot be written.
void write_dng(const std::string& path, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const RawMetadata& metadata);

}  // namespace scattermeter::capture
