#include "capture/sensor/frame_samples.h"

#include "capture/sensor/linear_samples.h"
#include "core/base/input_error.h"

namespace scattermeter::capture {

CorrectedSamples frame_samples(const RawFrame& frame, const SensorNoise& noise,
                               const RadianceCorrection* correction, const std::string& file,
                               const PixelRect& rect,
                               const std::optional<std::array<double, kRgb>>& frame_mean_counts) {
  if (correction == nullptr) {
    return {
        linear_samples(frame, noise, frame.exposure_s, rect.x0, rect.y0, rect.width, rect.height),
        0.0,
        {},
        0.0};
  }
  if (const std::string problem = correction_problem(frame, *correction); !problem.empty()) {
    throw InputError(file, problem);
  }
  return corrected_samples(frame, *correction, rect.x0, rect.y0, rect.width, rect.height,
                           frame_mean_counts);
}

}  // namespace scattermeter::capture
