#include "calib/radiance/radiance_steps.h"

#include <array>

#include "capture/sensor/corrected_samples.h"
#include "capture/sensor/saturation.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {

capture::RawFrame open_radiance_shot(RadianceSteps& steps, const RadianceShot& shot) {
  capture::RawFrame frame = steps.open(shot);
  capture::RadianceCorrection& c = steps.calibration.correction;
  if (!(frame.exposure_s > 0.0)) throw InputError(shot.file, "the file states no exposure time");
  if (c.width_px == 0) {
    c.width_px = frame.width_px;
    c.height_px = frame.height_px;
    c.iso = frame.iso;
    c.f_number = frame.f_number;
    c.vignetting = vignetting_of_frame(frame.width_px, frame.height_px);
  }
  // Values that the first file does not state are taken from the next.
  if (c.iso == 0.0) c.iso = frame.iso;
  if (c.f_number == 0.0) c.f_number = frame.f_number;
  if (const std::string problem = capture::correction_problem(frame, c); !problem.empty()) {
    throw InputError(shot.file, problem + " (as in its first dark frame)");
  }
  return frame;
}

std::vector<std::uint8_t> marks_of(const capture::RawFrame& frame,
                                   const capture::RadianceCorrection& correction) {
  const std::array<double, 4> clip = capture::clip_levels(frame);
  std::vector<std::uint8_t> marks(frame.samples.size(), 0);
  const auto width = static_cast<std::size_t>(frame.width_px);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const std::size_t phase = 2 * ((i / width) & 1U) + ((i % width) & 1U);
    if (static_cast<double>(frame.samples[i]) >= clip[phase]) marks[i] = kSampleClipped;
  }
  for (const std::size_t i : correction.defect_pixels) marks[i] = kSampleDefect;
  return marks;
}

std::array<double, 4> black_at(const capture::RadianceCorrection& correction, double exposure_s) {
  std::array<double, 4> black = correction.black_counts;
  for (std::size_t p = 0; p < 4; ++p) black[p] += correction.dark_counts_per_s[p] * exposure_s;
  return black;
}

}  // namespace scattermeter::calib
