#include "capture/shots/raw_shot.h"

#include <fmt/core.h>

#include "capture/raw/raw_reader.h"
#include "capture/sensor/mended_frame.h"
#include "capture/sensor/radiance_calibration.h"
#include "capture/shots/same_camera.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {

RawFrame open_shot(const Scene& scene, const ShotDecoding& decoding, const std::string& path) {
  RawFrame frame = read_raw(path, decoding.max_megapixels);
  if (!scene.camera.model.empty() && !same_camera(scene.camera.model, frame.make, frame.model)) {
    throw InputError(path, fmt::format("camera.model: shot with a {} {}, but the rig {} says {}",
                                       frame.make, frame.model, scene.source, scene.camera.model));
  }
  const CameraIntrinsics& k = scene.camera.intrinsics;
  if (frame.width_px != k.width_px || frame.height_px != k.height_px) {
    throw InputError(
        path, fmt::format("camera.image_size_px: {} x {} samples, but the rig {} says "
                          "{} x {}",
                          frame.width_px, frame.height_px, scene.source, k.width_px, k.height_px));
  }
  if (!(frame.exposure_s > 0.0)) {
    throw InputError(path, "the file states no exposure time");
  }
  if (decoding.radiance) mend_defects(decoding.radiance->correction.defect_pixels, frame);
  return frame;
}

}  // namespace scattermeter::capture
