// Light probes from files.
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

// Reads a Radiance picture (.hdr, RGBE) or an OpenEXR file (half or float, channels R, G, B); which
// one, its first bytes tell. Every finite value of at least 0 is taken as it stands. Throws
// InputError, one message, naming the file and what is wrong: missing, unreadable, of another
// format, cut short, too large, without one of the channels, a part of a picture only, black, or a
// pixel (x, y) whose channel is negative or not finite.
ProbeImage read_probe(const std::string& path, const ProbeLimits& limits = {});

}  // namespace scattermeter::capture
