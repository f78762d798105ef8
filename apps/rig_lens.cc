#include "apps/rig_lens.h"

#include "calib/camera_calibration_file.h"
#include "core/covariance_root.h"

namespace scattermeter::apps {

LensRoot lens_root(const RigCamera& camera) {
  if (!camera.lens || camera.lens->covariance.isZero(0.0)) {
    return LensRoot(calib::kLensParameters, 0);
  }
  return calib::parameter_map(calib::lens_model_of(camera.lens->parameters)) *
         covariance_root(camera.lens->covariance);
}

}  // namespace scattermeter::apps
