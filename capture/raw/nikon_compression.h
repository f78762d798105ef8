// Nikon's 12-bit raw compression.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace scattermeter::capture {

// The bytes of a compressed strip (Compression 34713) as bodies of the years 2003 to 2007 write
// them ("lossy, type 1", which in itself loses nothing: the loss is that of the tone curve). A
// sample is predicted by its neighbour of the same CFA phase, two columns to the left; in the first
// two columns two rows above; in the first two rows of those by `first_prediction`. The difference
// is written as its number of bits in a fixed Huffman code, followed by these bits; negative ones
// are those of the difference less one, as in lossless JPEG (ITU-T T.81, F.1.2.1). Source of the
// code: dcraw 9.28, nikon_load_raw().
// codes: width_px * height_px values below 4096, row by row. first_prediction: at most 4095.
// Throws std::invalid_argument for arguments out of these ranges.
std::vector<std::uint8_t> nikon_compressed(const std::vector<std::uint16_t>& codes, int width_px,
                                           int height_px, std::uint16_t first_prediction);

}  // namespace scattermeter::capture
