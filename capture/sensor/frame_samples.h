// A rectangle of a frame as linear samples, with or without a radiance calibration.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "capture/raw/raw_frame.h"
#include "capture/sensor/corrected_samples.h"
#include "capture/sensor/noise_model.h"
#include "capture/sensor/radiance_correction.h"
#include "core/camera/pixel_rect.h"

namespace scattermeter::capture {

// corrected_samples() by `correction`; where that is null, linear_samples() with `noise`, and the
// errors that samples share are 0. frame_mean_counts: see corrected_samples(). Throws InputError,
// naming `file`, for a frame to which the correction does not apply (correction_problem()).
CorrectedSamples frame_samples(
    const RawFrame& frame, const SensorNoise& noise, const RadianceCorrection* correction,
    const std::string& file, const PixelRect& rect,
    const std::optional<std::array<double, kRgb>>& frame_mean_counts = std::nullopt);

}  // namespace scattermeter::capture
