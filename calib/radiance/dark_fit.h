// Black and dark current from dark frames.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scattermeter::calib {

struct DarkFrame {
  double exposure_s = 0;
  std::array<double, 4> mean_counts{};  // per phase, black included
  std::array<double, 4> std_of_mean{};  // from the samples' scatter
};

struct DarkFit {
  std::array<double, 4> black_counts{};
  std::array<double, 4> dark_counts_per_s{};
  // Standard deviation of the black of one frame, common to its phases: the scatter between frames
  // beyond the noise of their means, and the error of the fit. Only the latter unless there are at
  // least two more frames than parameters.
  double black_std_counts = 0;
  bool scatter_known = false;
  bool rate_known = false;              // exposures differ by at least a factor of 2
  std::vector<double> residual_counts;  // per frame, mean over the phases
  double rms_counts = 0, worst_counts = 0;
};

// mean = black + rate * exposure per phase, least squares over the frames. One exposure: rate 0.
// Precondition (std::invalid_argument): at least one frame.
DarkFit fit_dark(const std::vector<DarkFrame>& frames);

// Mean and scatter of each phase of a frame without its hot pixels: samples more than eight
// standard deviations (of the samples around the median; at least 8 counts) from the median are
// left out, as are marked pixels.
DarkFrame dark_frame(std::span<const std::uint16_t> samples, std::span<const std::uint8_t> marks,
                     int width_px, double exposure_s);

// Pixels whose mean over the frames lies above its phase's median by more than six standard
// deviations of such a mean (std_counts: of a sample) and more than min_counts; ascending. sums:
// sums over n_frames frames.
std::vector<std::size_t> hot_pixels(std::span<const float> sums, int n_frames, int width_px,
                                    double std_counts, double min_counts);

// Unevenness of a dark frame: the largest departure of the mean of a block (about 8 x 8 of them
// over the frame) from the mean of its phase, in counts, and the standard deviation of the mean of
// a block.
struct Unevenness {
  double counts = 0;
  double std = 0;
};
Unevenness unevenness(std::span<const std::uint16_t> samples, std::span<const std::uint8_t> marks,
                      int width_px);

}  // namespace scattermeter::calib
