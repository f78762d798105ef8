#include "apps/shot_samples.h"

#include "apps/radiance_file.h"
#include "capture/linear_samples.h"
#include "core/input_error.h"

namespace scattermeter::apps {

capture::CorrectedSamples shot_samples(const Rig& rig, const capture::RawFrame& frame,
                                       const std::string& file, int x0, int y0, int width,
                                       int height) {
  if (!rig.camera.radiance) {
    return {capture::linear_samples(frame, rig.camera.sensor.noise, frame.exposure_s, x0, y0, width,
                                    height),
            0.0,
            {},
            0.0};
  }
  const capture::RadianceCorrection& correction = rig.camera.radiance->correction;
  if (const std::string problem = capture::correction_problem(frame, correction);
      !problem.empty()) {
    throw InputError(file, problem);
  }
  return capture::corrected_samples(frame, correction, x0, y0, width, height);
}

}  // namespace scattermeter::apps
