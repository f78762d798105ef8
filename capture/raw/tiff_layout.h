// The layout of the samples in a TIFF-based raw file (DNG, NEF, PEF, ARW, ...).
#pragma once

#include <array>
#include <string>

namespace scattermeter::capture {

struct TiffLayout {
  // Why LibRaw 0.20 cannot decode the colour-filter-array image of the file correctly; empty when
  // no reason is known (also for a file that is not a TIFF):
  //  - strips or tiles extend beyond the end of the file, which is truncated. LibRaw reports
  //    missing samples, but not that only the last bytes of a compressed stream are missing;
  //  - DNG, lossless JPEG in more than one strip: decoded to wrong samples without an error;
  //  - DNG, uncompressed in strips that are not contiguous, or in more than one tile: LibRaw reads
  //    on from the first one;
  //  - DNG, uncompressed in fewer bytes than its size requires.
  std::string problem;
  // Corner {left, top} of a DNG's active area on the sensor. LibRaw moves an odd corner to the next
  // even position and the colour pattern with it, but not the pattern of the black level.
  std::array<int, 2> active_corner_px = {0, 0};
  bool is_dng = false;
};

// Throws InputError naming the file when it cannot be read.
TiffLayout tiff_layout(const std::string& path);

}  // namespace scattermeter::capture
