// Writing of synthetic raw files as a Nikon D80 makes them (NEF).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "capture/raw/raw_metadata.h"

namespace scattermeter::capture {

// Writes a 12-bit compressed NEF that LibRaw, dcraw and exiftool read: big-endian TIFF with a
// thumbnail, sub-directory with the compressed samples, EXIF directory with Nikon's maker note.
// metadata: make and model must be those of a D80 (the defaults), because decoders take the borders
// of the frame from the model (a D80 has 4 columns and 3 rows beyond its frame, which are
// written, too), and the white level 4095, for which a NEF has no field. The linearisation table
// must not be empty and be strictly ascending.
// Other preconditions: those of check_raw(). Of a frame smaller than 22 x 22 LibRaw takes none. The
// file appears under `path` complete or not at all. Throws std::invalid_argument for arguments out
// of these ranges, and InputError naming the file when it cannot be written.
void write_nef(const std::string& path, int width_px, int height_px,
               const std::vector<std::uint16_t>& codes, const RawMetadata& metadata);

}  // namespace scattermeter::capture
