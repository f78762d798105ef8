// Decoding and encoding of OpenEXR files.
#pragma once

#include <map>
#include <string>

#include "capture/files/probe_reader.h"

namespace scattermeter::capture {

bool is_exr(const std::string& bytes);

// Decodes the channels R, G and B (half or float) of a file held in `bytes`; `path` is used in
// messages only. Throws InputError for a file that is damaged, truncated, too large, deep or
// without one of the channels, for integer or subsampled channels, and for a data window other than
// the display window. The values themselves are not checked here.
ProbeImage decode_exr(const std::string& path, const std::string& bytes, const ProbeLimits& limits);

// The bytes of a file with channels R, G and B of 32-bit floats and ZIP compression. `notes`: text
// attributes of the header by name. Throws std::invalid_argument when the number of values does not
// match the size.
std::string encode_exr(const ProbeImage& image, const std::map<std::string, std::string>& notes);

}  // namespace scattermeter::capture
