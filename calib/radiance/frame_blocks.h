// Division of a frame into blocks, to which photon transfer, linearity and vignetting are fitted.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scattermeter::calib {

// All samples of one phase of the 2 x 2 filter pattern in a rectangle of pixels:
// x = x0, x0 + 2 ... < x1, y = y0, y0 + 2 ... < y1.
struct Block {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int phase = 0;
};

// The frame divided into about columns x rows rectangles with even sides, of four blocks each.
// Throws std::invalid_argument unless each rectangle has at least 2 pixels on each side.
std::vector<Block> blocks_of_frame(int width_px, int height_px, int columns, int rows);

struct BlockMean {
  double counts = 0;
  int n = 0;  // number of samples; 0: there are none, or one is clipped
};

// The mean of samples minus black[phase] for each block. Marks of pixels: 0 usable, 1 clipped
// (excludes its block), 2 defect (only the pixel is left out).
std::vector<BlockMean> block_means(std::span<const std::uint16_t> samples,
                                   std::span<const std::uint8_t> marks, int width_px,
                                   const std::array<double, 4>& black,
                                   const std::vector<Block>& blocks);

// Half the variance of the difference of two frames with the same light within each block: the
// noise of one frame, free of what both have in common (pixel response, gradients) and of a
// difference in level.
struct PairVariance {
  double counts = 0;  // mean of both frames
  double variance_counts2 = 0;
  int n = 0;  // number of samples, n - 1 degrees of freedom; 0: left out
};
std::vector<PairVariance> pair_variances(std::span<const std::uint16_t> a,
                                         std::span<const std::uint16_t> b,
                                         std::span<const std::uint8_t> marks, int width_px,
                                         const std::array<double, 4>& black,
                                         const std::vector<Block>& blocks);

}  // namespace scattermeter::calib
