// Correction of a camera's raw frames by a radiance calibration.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "capture/sensor/noise_model.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/response_curve.h"
#include "core/camera/vignetting.h"

namespace scattermeter::capture {

// The ratio of true to stated exposure time for one setting of the shutter. The mean of its
// logarithm over all settings of a calibration is 0: a common factor is part of the responsivity.
struct ShutterSetting {
  double stated_s = 0;
  double true_over_stated = 1;
  double relative_std = 0;
};

// The correction for one camera, ISO and aperture.
struct RadianceCorrection {
  int width_px = 0, height_px = 0;
  double iso = 0;
  double f_number = 0;
  // Dark signal for each phase: black_counts + dark_counts_per_s * exposure_s.
  std::array<double, 4> black_counts{};
  std::array<double, 4> dark_counts_per_s{};
  double black_std_counts = 0;  // of the black of one shot: frame to frame, and of the fit
  std::array<SensorNoise, kRgb> noise;
  std::vector<std::size_t> defect_pixels;  // ascending; y * width_px + x
  std::array<ResponseCurve, kRgb> response;
  Vignetting vignetting;
  double vignetting_std = 0;  // of the relative illumination, rms over the frame
  // This share of the frame mean of its colour is subtracted from each pixel.
  std::array<double, kRgb> glare_share{};
  std::array<double, kRgb> glare_std{};
  std::vector<ShutterSetting> shutter;  // by stated_s, ascending
  double shutter_relative_std = 0;      // of settings that are not in `shutter`

  // The setting for a stated time (within 0.1 %), or else one with ratio 1 and
  // shutter_relative_std.
  ShutterSetting setting(double stated_s) const;
};

}  // namespace scattermeter::capture
