// Reading of raw files, the door to LibRaw.
#pragma once

#include <string>

#include "capture/raw/raw_frame.h"

namespace scattermeter::capture {

// Decodes any raw file that LibRaw supports and that has a 2 x 2 RGB colour filter array, without
// demosaicing, white balance, brightness adjustment or black subtraction. Of a file with several
// images the first is read. An active area that starts at an odd row or column of the sensor loses
// that row or column (LibRaw starts at an even one); pattern and black levels follow. Black levels
// that repeat over more than 2 x 2 samples are averaged for each phase. Exposure, ISO and aperture
// have the seven digits of a float.
// Throws InputError naming the file when it
//  - is missing, not a raw file, truncated or damaged,
//  - is of a make that LibRaw is not safe with (see refused_make.h),
//  - has no 2 x 2 RGB colour filter array (full colour, YCbCr, monochrome, X-Trans, four colours),
//  - claims more than `max_megapixels`, checked before memory is allocated for samples,
//  - has a layout that LibRaw would decode wrongly without an error (see tiff_layout.h).
// Damage inside a compressed stream that still decodes cannot be detected: the formats have no
// checksum. Safe to call from several threads at once.
RawFrame read_raw(const std::string& path, double max_megapixels = 400.0);

// The program that wrote the file, as its metadata state; "" if they do not, or it is no raw file.
std::string writer_of_raw(const std::string& path);

}  // namespace scattermeter::capture
