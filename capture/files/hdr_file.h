// Decoding of Radiance pictures (.hdr).
#pragma once

#include <string>

#include "capture/files/probe_reader.h"

namespace scattermeter::capture {

bool is_hdr(const std::string& bytes);

// Decodes a file held in `bytes`; `path` is used in messages only. Supports RGBE, run-length
// encoded or flat, with rows from the top and pixels from the left (-Y +X). Throws InputError for
// anything else and for a truncated file. The values themselves are not checked here.
ProbeImage decode_hdr(const std::string& path, const std::string& bytes, const ProbeLimits& limits);

}  // namespace scattermeter::capture
