// Runs a program and takes what it prints.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace scattermeter::capture {

// Standard output of `program` with its arguments; std::runtime_error when it cannot be run or
// leaves with another status than 0. Arguments are quoted for the shell.
std::vector<std::uint8_t> output_of(const std::string& program,
                                    const std::vector<std::string>& arguments);

// The undemosaiced samples of a raw file as `dcraw -D -4` writes them: tone curve undone, nothing
// subtracted or scaled, active area only.
struct DcrawFrame {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> samples;
};
DcrawFrame dcraw_frame(const std::string& path);

}  // namespace scattermeter::capture
