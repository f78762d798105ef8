#include "tests/capture/process.h"

#include <array>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace scattermeter::capture {

std::vector<std::uint8_t> output_of(const std::string& program,
                                    const std::vector<std::string>& arguments) {
  std::string command = program;
  for (const std::string& argument : arguments) command += " '" + argument + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::vector<std::uint8_t> output;
  std::array<std::uint8_t, 65536> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;) {
    output.insert(output.end(), buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(n));
  }
  const int status = ::pclose(pipe);
  if (status != 0) throw std::runtime_error(command + " failed: " + std::to_string(status));
  return output;
}

DcrawFrame dcraw_frame(const std::string& path) {
  const std::vector<std::uint8_t> pgm = output_of("dcraw", {"-D", "-4", "-t", "0", "-c", path});
  // "P5\n<width> <height>\n65535\n", then 16 bits a sample, the high byte first.
  std::istringstream header(std::string(pgm.begin(), pgm.begin() + 64));
  std::string magic;
  int largest = 0;
  DcrawFrame frame;
  header >> magic >> frame.width_px >> frame.height_px >> largest;
  const std::size_t begin = static_cast<std::size_t>(header.tellg()) + 1;
  const auto count =
      static_cast<std::size_t>(frame.width_px) * static_cast<std::size_t>(frame.height_px);
  if (magic != "P5" || largest != 65535 || pgm.size() != begin + 2 * count) {
    throw std::runtime_error("dcraw wrote no 16-bit PGM for " + path);
  }
  for (std::size_t i = begin; i < pgm.size(); i += 2) {
    frame.samples.push_back(static_cast<std::uint16_t>(pgm[i] << 8U | pgm[i + 1]));
  }
  return frame;
}

}  // namespace scattermeter::capture
