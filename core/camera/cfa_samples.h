// Linear samples of a colour filter array, with their noise: a shot as core receives it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace scattermeter {

inline constexpr int kRgb = 3;  // colour channels: R, G, B
inline constexpr std::array<char, 3> kRgbName = {'R', 'G', 'B'};

// Index of sample (x, y) in the 2 x 2 filter pattern: 2 (y odd) + (x odd).
inline std::size_t cfa_phase(int x, int y) {
  return 2 * (static_cast<std::size_t>(y) & 1U) + (static_cast<std::size_t>(x) & 1U);
}

// Why a sample is not used.
inline constexpr std::uint8_t kSampleClipped = 1;  // the signal is a lower bound
inline constexpr std::uint8_t kSampleDefect = 2;   // carries no information: a hot pixel

// A rectangle of samples of one shot. Pixel (x, y) counts from the first sample of the active area.
struct CfaSamples {
  int x0 = 0, y0 = 0, width = 0, height = 0;  // the rectangle, px
  std::array<int, 4> channel_of_phase{};      // 0 R, 1 G, 2 B; index 2 (y & 1) + (x & 1)
  double exposure_s = 0;
  std::vector<float> signal_counts;     // above black; row by row; noise can make it negative
  std::vector<float> variance_counts2;  // of signal_counts
  std::vector<std::uint8_t> clipped;    // 0, or one of the above; the signal is then unusable
  // Samples below this many counts above black are cut at zero by the camera; 0 when black lies
  // high enough for the noise to swing both ways.
  double floor_counts = 0;
  // Photon noise: the variance grows by this many counts^2 for every count of signal (one over the
  // gain in electrons per count).
  double variance_per_count = 0;
  // The same per sample, row by row; empty: equal for all.
  std::vector<float> variance_per_count_of;
  // For a bracket (capture/sensor/merged_samples.h), else empty. Per exposure: its share of each
  // sample's signal. The shares of a sample add up to 1; all are 0 for a defective sample.
  std::vector<std::vector<float>> part_of_exposure;

  int channel(int x, int y) const { return channel_of_phase[cfa_phase(x, y)]; }
};

}  // namespace scattermeter
