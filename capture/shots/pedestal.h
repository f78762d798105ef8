// What a raw's samples contain besides light from the object: errors of the black level, and glare.
#pragma once

#include <array>

#include "capture/raw/raw_frame.h"
#include "core/camera/cfa_samples.h"
#include "core/camera/pixel_rect.h"

namespace scattermeter::capture {

// Of a background that is brighter than black: the part that is taken for pedestal.
inline constexpr double kPedestalShare = 0.5;

// Counts above the file's black level, R G B, common to all samples of a channel.
struct Pedestal {
  std::array<double, kRgb> counts{};
  std::array<double, kRgb> std_counts{};
  // ShotExposure::beside_counts.
  std::array<double, kRgb> beside_counts{};
};

// From the frame outside the rectangle around the object, which shows the pedestal plus whatever
// light the background itself returns. Where its darkest tenth lies B above black, the pedestal is
// 0.5 B with a standard deviation of 0.4 B: a background that is black shows the whole of B, a grey
// one none of it; a background below black is all pedestal. In addition, it is uncertain by 0.1
// counts and by a thousandth of the frame's mean, as glare is not uniform. Where the object fills
// the frame the background tells nothing: then one count and a hundredth of the frame's mean, about
// 0.
Pedestal pedestal_of(const RawFrame& frame, const PixelRect& object);

}  // namespace scattermeter::capture
