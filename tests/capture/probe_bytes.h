// Light probes as files, written for tests.
#pragma once

#include <string>

#include "capture/probe_reader.h"

namespace scattermeter::capture {

// A Radiance picture: run-length coded as by default (a run wherever three bytes agree), or flat.
// Values are rounded down to RGBE.
std::string hdr_bytes(const ProbeImage& image, bool run_length = true);

enum class ExrType { kHalf, kFloat, kUint };
// OpenEXR, ZIP compressed. channels: a subset of "RGB", or others.
std::string exr_bytes(const ProbeImage& image, ExrType type, const std::string& channels = "RGB");

}  // namespace scattermeter::capture
