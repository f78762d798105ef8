// Where a frame's samples stop following the light.
#pragma once

#include <array>

#include "capture/raw_frame.h"

namespace scattermeter::capture {

// The count from which on a sample is clipped, per CFA phase (a sample v is clipped when
// v >= clip_counts[phase]). The smallest of
//  - the white level of the file,
//  - the top of the decoded tone curve, where the file has one (a compressed NEF's ends below the
//    `maximum` that LibRaw reports),
//  - the frame's own ceiling: the largest value of the phase, when so many samples pile up on it
//    that a smooth histogram cannot explain them (a body that saturates below its nominal white).
// The pile-up rule never fires on a largest value that fewer than 32 samples have or that lies
// below half of the white level, nor on a frame without noise: where a frame was computed without
// noise, uniform places pile up too. A frame that is clipped, or dark, in every sample shows no
// noise either and is left to the first two rules. Derivation and limits in saturation.cc. One pass
// over the samples, 12 ms for 10 megapixels; a second one where a pile is suspected.
std::array<double, 4> clip_levels(const RawFrame& frame);

}  // namespace scattermeter::capture
