#include "calib/radiance/frame_blocks.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace scattermeter::calib {
namespace {

// Even edges that divide `size` into `parts`.
int edge(int size, int parts, int i) {
  if (i == parts) return size;
  return static_cast<int>(static_cast<std::int64_t>(size / 2) * i / parts) * 2;
}

void check_sizes(std::size_t samples, std::size_t marks, int width_px) {
  if (samples != marks || width_px < 1 || samples % static_cast<std::size_t>(width_px) != 0) {
    throw std::invalid_argument("frame_blocks: " + std::to_string(samples) + " samples and " +
                                std::to_string(marks) + " marks in rows of " +
                                std::to_string(width_px));
  }
}

}  // namespace

std::vector<Block> blocks_of_frame(int width_px, int height_px, int columns, int rows) {
  if (columns < 1 || rows < 1 || width_px < 2 * columns || height_px < 2 * rows) {
    throw std::invalid_argument("blocks_of_frame: " + std::to_string(columns) + " x " +
                                std::to_string(rows) + " blocks in " + std::to_string(width_px) +
                                " x " + std::to_string(height_px) + " pixels");
  }
  std::vector<Block> blocks;
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      for (int phase = 0; phase < 4; ++phase) {
        blocks.push_back({edge(width_px, columns, c) + (phase & 1),
                          edge(height_px, rows, r) + (phase >> 1), edge(width_px, columns, c + 1),
                          edge(height_px, rows, r + 1), phase});
      }
    }
  }
  return blocks;
}

std::vector<BlockMean> block_means(std::span<const std::uint16_t> samples,
                                   std::span<const std::uint8_t> marks, int width_px,
                                   const std::array<double, 4>& black,
                                   const std::vector<Block>& blocks) {
  check_sizes(samples.size(), marks.size(), width_px);
  const auto width = static_cast<std::size_t>(width_px);
  std::vector<BlockMean> out;
  for (const Block& b : blocks) {
    double sum = 0;
    int n = 0;
    bool clipped = false;
    for (int y = b.y0; y < b.y1; y += 2) {
      for (int x = b.x0; x < b.x1; x += 2) {
        const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        clipped = clipped || marks[i] == 1;
        if (marks[i] != 0) continue;
        sum += samples[i];
        ++n;
      }
    }
    if (clipped || n == 0) {
      out.emplace_back();
    } else {
      out.push_back({sum / n - black[static_cast<std::size_t>(b.phase)], n});
    }
  }
  return out;
}

std::vector<PairVariance> pair_variances(std::span<const std::uint16_t> a,
                                         std::span<const std::uint16_t> b,
                                         std::span<const std::uint8_t> marks, int width_px,
                                         const std::array<double, 4>& black,
                                         const std::vector<Block>& blocks) {
  check_sizes(a.size(), marks.size(), width_px);
  check_sizes(b.size(), marks.size(), width_px);
  const auto width = static_cast<std::size_t>(width_px);
  std::vector<PairVariance> out;
  for (const Block& block : blocks) {
    double sum = 0, d_sum = 0, d_squares = 0;
    int n = 0;
    bool clipped = false;
    for (int y = block.y0; y < block.y1; y += 2) {
      for (int x = block.x0; x < block.x1; x += 2) {
        const std::size_t i = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
        clipped = clipped || marks[i] == 1;
        if (marks[i] != 0) continue;
        const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        sum += 0.5 * (static_cast<double>(a[i]) + static_cast<double>(b[i]));
        d_sum += d;
        d_squares += d * d;
        ++n;
      }
    }
    if (clipped || n < 4) {
      out.emplace_back();
      continue;
    }
    out.push_back({sum / n - black[static_cast<std::size_t>(block.phase)],
                   0.5 * (d_squares - d_sum * d_sum / n) / (n - 1), n});
  }
  return out;
}

}  // namespace scattermeter::calib
