// Raw files through LibRaw.
#pragma once

#include <string>

#include "capture/raw_frame.h"

namespace scattermeter::capture {

// Decodes any raw file that LibRaw knows and that holds a 2 x 2 RGB colour filter array.
// No demosaic, white balance, brightness or black subtraction takes place. The first image of a
// file that holds several is taken. An active area that starts at an odd place of the sensor loses
// that row or column (LibRaw starts at an even one); pattern and black levels follow. Black levels
// that repeat over more than 2 x 2 samples are averaged per phase. Exposure, ISO and aperture carry
// a float's seven digits. Throws InputError, naming the file, when it is missing, no raw, cut off
// or damaged, has no 2 x 2 RGB colour filter array (full colour, YCbCr, monochrome, X-Trans, four
// colours), or claims more than `max_megapixels` (checked before any memory is taken for samples;
// the message names the rig's key that raises it), or is laid out in a way that LibRaw would decode
// wrongly without a word (see tiff_layout.h). Damage inside a compressed stream that still decodes
// cannot be told: the formats carry no checksum. Safe to call from several threads at once, each
// with its own file.
RawFrame read_raw(const std::string& path, double max_megapixels = 400.0);

}  // namespace scattermeter::capture
