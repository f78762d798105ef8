#include "capture/files/probe_reader.h"

#include "capture/files/exr_file.h"
#include "capture/files/file_text.h"
#include "capture/files/hdr_file.h"
#include "core/base/input_error.h"
#include "core/light/environment.h"

namespace scattermeter::capture {
ProbeImage read_probe(const std::string& path, const ProbeLimits& limits) {
  const std::string bytes = file_text(path, "the image of a light probe is expected");
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
