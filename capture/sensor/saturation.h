// Saturation levels of a frame.
#pragma once

#include <array>

#include "capture/raw/raw_frame.h"

namespace scattermeter::capture {

// The clip level of each CFA phase: a sample v is clipped when v >= clip_levels()[phase]. It is the
// smallest of
//  - the white level of the file,
//  - the top of the decoded tone curve, where the file has one (a compressed NEF's ends below the
//    `maximum` that LibRaw reports),
//  - the value on which more samples of the phase pile up than a smooth histogram can explain (a
//    camera that saturates below its nominal white level), if few samples lie above it: at most
//    1/16 of the pile-up, such as defect pixels, which are clipped, too.
// The pile-up rule does not apply to a value that fewer than 37 samples have or that lies below a
// quarter of the white level, nor to a frame computed without noise, in which uniform areas pile
// up, too. A frame in which every sample is clipped or dark shows no noise either, so only the
// first two rules apply. See saturation.cc for derivation and limits. One pass over the samples, 12
// ms for 10 megapixels, and a second one if a pile-up is suspected.
std::array<double, 4> clip_levels(const RawFrame& frame);

}  // namespace scattermeter::capture
