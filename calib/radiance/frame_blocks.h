// A frame of samples in blocks: what photon transfer, linearity and vignetting are fitted to.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scattermeter::calib {

// Every sample of one phase of the 2 x 2 filter pattern in a rectangle of pixels:
// x = x0, x0 + 2 ... < x1, y = y0, y0 + 2 ... < y1.
struct Block {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int phase = 0;
};

// The frame cut into about columns x rows rectangles with even sides, four blocks each.
// Preconditions (std::invalid_argument): at least 2 pixels a rectangle.
std::vector<Block> blocks_of_frame(int width_px, int height_px, int columns, int rows);

struct BlockMean {
  double counts = 0;
  int n = 0;  // samples; 0: the block has none, or a clipped one
};

// Pixels: 0 usable, 1 clipped (takes its block out), 2 defect (left out alone); capture's marks.
// samples less black[phase].
std::vector<BlockMean> block_means(std::span<const std::uint16_t> samples,
                                   std::span<const std::uint8_t> marks, int width_px,
                                   const std::array<double, 4>& black,
                                   const std::vector<Block>& blocks);

// Half the variance of the difference of two frames of the same light, inside each block: the noise
// of one frame, free of what both share (pixel response, gradients) and of a difference in level.
struct PairVariance {
  double counts = 0;  // mean of both frames
  double variance_counts2 = 0;
  int n = 0;  // samples; the variance has n - 1 degrees of freedom; 0: left out
};
std::vector<PairVariance> pair_variances(std::span<const std::uint16_t> a,
                                         std::span<const std::uint16_t> b,
                                         std::span<const std::uint8_t> marks, int width_px,
                                         const std::array<double, 4>& black,
                                         const std::vector<Block>& blocks);

}  // namespace scattermeter::calib
