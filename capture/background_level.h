// How bright a frame is where nothing is to be seen.
#pragma once

#include <array>
#include <cstddef>

#include "capture/raw_frame.h"

namespace scattermeter::capture {

// Counts above the file's black level, by channel, over square blocks of samples.
struct BackgroundLevel {
  std::size_t blocks = 0;  // 0: the frame holds nothing but the rectangle; the rest is 0, too
  int block_px = 0;        // their edge
  // The level below which a tenth of the blocks' means lie: black itself, where any of the
  // background is dark. By selection it lies up to 1.3 block_std below the mean of an even
  // background.
  std::array<double, kChannels> darkest_counts{};
  std::array<double, kChannels> median_counts{};
  std::array<double, kChannels> block_std_counts{};  // of a block's mean, by its samples' scatter
};

// Of the frame outside the rectangle [x0, x0 + width) x [y0, y0 + height). Blocks are a fortieth of
// the frame's width, at least 16 samples. Precondition (std::invalid_argument): the frame's samples
// are there.
BackgroundLevel background_level(const RawFrame& frame, int x0, int y0, int width, int height);

}  // namespace scattermeter::capture
