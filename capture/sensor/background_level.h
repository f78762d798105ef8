// Brightness of the background of a frame.
#pragma once

#include <array>
#include <cstddef>

#include "capture/raw/raw_frame.h"

namespace scattermeter::capture {

// Statistics, for each channel, of the means of square blocks of samples in counts above the black
// level of the file.
struct BackgroundLevel {
  std::size_t blocks = 0;  // 0: the rectangle fills the frame; all other members are 0, too
  int block_px = 0;        // edge of a block
  // The tenth percentile of the block means: the black level itself if part of the background is
  // dark. By selection it lies up to 1.3 block_std below the mean of a uniform background.
  std::array<double, kChannels> darkest_counts{};
  std::array<double, kChannels> median_counts{};
  std::array<double, kChannels> block_std_counts{};  // of a block mean, from the scatter of samples
  // The mean of the blocks that touch the rectangle or lie within a block's edge of it.
  std::size_t blocks_beside = 0;
  std::array<double, kChannels> beside_counts{};
};

// The background outside the rectangle [x0, x0 + width) x [y0, y0 + height), in px of the frame.
// The edge of a block is a fortieth of the frame width, at least 16 samples. Throws
// std::invalid_argument for a frame without samples.
BackgroundLevel background_level(const RawFrame& frame, int x0, int y0, int width, int height);

}  // namespace scattermeter::capture
