// What the directories of a TIFF-based raw file (DNG, NEF, PEF, ARW, ...) say about its samples.
#pragma once

#include <array>
#include <string>

namespace scattermeter::capture {

struct TiffLayout {
  // What keeps LibRaw 0.20 from decoding the colour-filter-array image of the file rightly, or an
  // empty string when nothing is known against it (also for a file that is no TIFF):
  //  - its strips or tiles reach past the end of the file: it was cut off. LibRaw stops where
  //    samples are missing, but not where only the last bytes of a compressed stream are;
  //  - DNG, lossless JPEG in more than one strip: decodes without an error to wrong samples;
  //  - DNG, uncompressed in strips that do not follow each other, or in more than one tile: LibRaw
  //    reads straight on from the first one;
  //  - DNG, uncompressed in fewer bytes than its size asks for.
  std::string problem;
  // Corner of a DNG's active area on the sensor: {left, top}. LibRaw moves an odd corner to the
  // next even place (and the colour pattern with it, but not the pattern of the black level).
  std::array<int, 2> active_corner_px = {0, 0};
  bool is_dng = false;
};

// Throws InputError when the file cannot be read at all.
TiffLayout tiff_layout(const std::string& path);

}  // namespace scattermeter::capture
