// Radiance pictures (.hdr).
#pragma once

#include <string>

#include "capture/probe_reader.h"

namespace scattermeter::capture {

bool is_hdr(const std::string& bytes);

// Decodes a whole file held in `bytes`; `path` is for messages. Rows from the top, left to right
// (-Y +X), RGBE, run-length coded or flat. Throws InputError for everything else, and for a file
// that is cut short. Values are as decoded; they are not judged here.
ProbeImage decode_hdr(const std::string& path, const std::string& bytes, const ProbeLimits& limits);

}  // namespace scattermeter::capture
