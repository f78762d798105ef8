#include "capture/files/probe_reader.h"

#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "capture/files/exr_file.h"
#include "capture/files/hdr_file.h"
#include "core/base/input_error.h"
#include "core/light/environment.h"

namespace scattermeter::capture {
namespace {

std::string read_bytes(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw MissingFile(path, "no such file");
  if (!std::filesystem::is_regular_file(status)) throw InputError(path, "is not a file");
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream bytes;
  if (!stream || ((bytes << stream.rdbuf()), stream.bad())) {
    throw InputError(path, "cannot be read");
  }
  return std::move(bytes).str();
}

}  // namespace

ProbeImage read_probe(const std::string& path, const ProbeLimits& limits) {
  const std::string bytes = read_bytes(path);
  ProbeImage image;
  if (is_exr(bytes)) {
    image = decode_exr(path, bytes, limits);
  } else if (is_hdr(bytes)) {
    image = decode_hdr(path, bytes, limits);
  } else {
    throw InputError(path, "is neither a Radiance picture (.hdr) nor an OpenEXR file");
  }
  if (const std::string problem = probe_problem(image.width_px, image.height_px, image.radiance);
      !problem.empty()) {
    throw InputError(path, problem);
  }
  return image;
}

}  // namespace scattermeter::capture
