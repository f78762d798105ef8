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

}  // namespace

bool same_camera(const std::string& wanted, const std::string& make, const std::string& model) {
  const std::string w = lower(wanted);
  const std::string m = lower(model);
  return w == m || w == lower(make) + " " + m;
}

capture::RawFrame open_shot(const Rig& rig, const std::string& path) {
  capture::RawFrame frame = capture::read_raw(path, rig.limits.raw_megapixels);
  if (!rig.camera.model.empty() && !same_camera(rig.camera.model, frame.make, frame.model)) {
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
