// What a radiance calibration says about the camera's raws.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "capture/noise_model.h"
#include "core/cfa_samples.h"
#include "core/response_curve.h"
#include "core/vignetting.h"

namespace scattermeter::capture {

// The time that the shutter was open over the time that the file states, for one setting. Over all
// settings of a calibration the mean logarithm is 0: a factor common to all is part of the
// responsivity.
struct ShutterSetting {
  double stated_s = 0;
  double true_over_stated = 1;
  double relative_std = 0;
};

// Holds for one camera, ISO and aperture.
struct RadianceCorrection {
  int width_px = 0, height_px = 0;
  double iso = 0;
  double f_number = 0;
  // Black of the dark frames, per phase: black + rate * exposure.
  std::array<double, 4> black_counts{};
  std::array<double, 4> dark_counts_per_s{};
  double black_std_counts = 0;  // of one shot's black: from frame to frame, and of the fit
  std::array<SensorNoise, kRgb> noise;
  std::vector<std::size_t> defect_pixels;  // ascending; y * width_px + x
  std::array<ResponseCurve, kRgb> response;
  // Of a response's logarithm at its last knot.
  std::array<double, kRgb> response_std{};
  Vignetting vignetting;
  double vignetting_std = 0;  // of a share, rms over the frame
  // A pixel's light is what is recorded less this share of the frame's mean of its colour.
  std::array<double, kRgb> glare_share{};
  std::array<double, kRgb> glare_std{};
  std::vector<ShutterSetting> shutter;  // by stated_s, ascending
  double shutter_relative_std = 0;      // of a setting that is not among them

  // The setting of a stated time (within 0.1 %), or one with factor 1 and shutter_relative_std.
  ShutterSetting setting(double stated_s) const;
};

}  // namespace scattermeter::capture
