#include "apps/raw_shot.h"

#include <algorithm>
#include <cctype>

#include <fmt/core.h>

#include "capture/raw_reader.h"
#include "core/input_error.h"

namespace scattermeter::apps {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// "NIKON D80", "Nikon D80" and "D80" are one camera: LibRaw shortens makes and strips them from
// models.
bool same_camera(const std::string& wanted, const capture::RawFrame& frame) {
  const std::string w = lower(wanted);
  const std::string model = lower(frame.model);
  return w == model || w == lower(frame.make) + " " + model;
}

}  // namespace

capture::RawFrame open_shot(const Rig& rig, const std::string& path) {
  capture::RawFrame frame = capture::read_raw(path);
  if (!rig.camera.model.empty() && !same_camera(rig.camera.model, frame)) {
    throw InputError(path, fmt::format("camera.model: shot with a {} {}, but the rig {} says {}",
                                       frame.make, frame.model, rig.path, rig.camera.model));
  }
  const calib::CameraIntrinsics& k = rig.camera.intrinsics;
  if (frame.width_px != k.width_px || frame.height_px != k.height_px) {
    throw InputError(
        path, fmt::format("camera.image_size_px: {} x {} samples, but the rig {} says "
                          "{} x {}",
                          frame.width_px, frame.height_px, rig.path, k.width_px, k.height_px));
  }
  if (!(frame.exposure_s > 0.0)) {
    throw InputError(path, "the file holds no exposure time");
  }
  return frame;
}

}  // namespace scattermeter::apps
