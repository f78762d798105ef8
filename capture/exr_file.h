// OpenEXR files.
#pragma once

#include <map>
#include <string>

#include "capture/probe_reader.h"

namespace scattermeter::capture {

bool is_exr(const std::string& bytes);

// Decodes channels R, G and B (half or float; integers are refused) of a file held in `bytes`;
// `path` is for messages. Throws InputError for a file that is damaged or cut short, too large,
// deep, without one of the channels, with subsampled ones, or that holds a part of its picture
// only. Values are as decoded; they are not judged here.
ProbeImage decode_exr(const std::string& path, const std::string& bytes, const ProbeLimits& limits);

// The bytes of a file of 32-bit floats, channels R, G and B, ZIP compression. `notes`: attributes
// of text in the header, by name. Throws std::invalid_argument where the sizes do not fit each
// other.
std::string encode_exr(const ProbeImage& image, const std::map<std::string, std::string>& notes);

}  // namespace scattermeter::capture
