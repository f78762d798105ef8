// OpenEXR files.
#pragma once

#include <string>

#include "capture/probe_reader.h"

namespace scattermeter::capture {

bool is_exr(const std::string& bytes);

// Decodes channels R, G and B (half or float; integers are refused) of a file held in `bytes`;
// `path` is for messages. Throws InputError for a file that is damaged or cut short, too large,
// deep, without one of the channels, with subsampled ones, or that holds a part of its picture
// only. Values are as decoded; they are not judged here.
ProbeImage decode_exr(const std::string& path, const std::string& bytes, const ProbeLimits& limits);

}  // namespace scattermeter::capture
