// Encoding of the maker note of a NEF.
#pragma once

#include <cstdint>
#include <vector>

#include "capture/raw/raw_metadata.h"

namespace scattermeter::capture {

// The value of the EXIF field MakerNote as bodies since 2000 write it (version 2.10): "Nikon", then
// a big-endian TIFF file of its own with the fields that a decoder needs: ISO speed, quality, white
// balance (neutral), compression (lossy, type 1) and the linearisation table, in front of which
// stands the prediction that nikon_compressed() begins with. Black levels other than 0, which
// bodies of these years do not have, are written as later ones do. Names and layout of the fields:
// ExifTool 12.57, Nikon tags.
// Preconditions: those of check_raw(), and a table.
std::vector<std::uint8_t> nikon_maker_note(const RawMetadata& metadata,
                                           std::uint16_t first_prediction);

}  // namespace scattermeter::capture
