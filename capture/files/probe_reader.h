// Reading of light probes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scattermeter::capture {

struct ProbeImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> radiance;  // linear, rows from the top, R G B of each pixel
};

struct ProbeLimits {
  std::size_t max_pixels = 64'000'000;
};

// Reads a Radiance picture (.hdr, RGBE) or an OpenEXR file (half or float, channels R, G, B), as
// recognised by its first bytes. Values are not modified. Throws InputError naming the file and the
// problem: missing, unreadable, of another format, truncated, too large, without one of the
// channels, part of a picture, black, or a pixel (x, y) with a channel that is negative or not
// finite.
ProbeImage read_probe(const std::string& path, const ProbeLimits& limits = {});

}  // namespace scattermeter::capture
