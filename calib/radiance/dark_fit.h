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
  // Standard deviation of one frame's black, common to its phases: what frames differ by beyond
  // their means' own noise, and the error of the fit. Without two frames more than parameters only
  // the latter.
  double black_std_counts = 0;
  bool scatter_known = false;
  bool rate_known = false;              // exposures differ by at least a factor of 2
  std::vector<double> residual_counts;  // per frame, mean over the phases
  double rms_counts = 0, worst_counts = 0;
};

// mean = black + rate * exposure per phase, least squares over the frames. One exposure: rate 0.
// Precondition (std::invalid_argument): at least one frame.
DarkFit fit_dark(const std::vector<DarkFrame>& frames);

// Mean and scatter of each phase of a frame without its hot pixels: what lies more than eight
// standard deviations (of the median's neighbourhood; at least 8 counts) from the median is left
// out, as are marked pixels.
DarkFrame dark_frame(std::span<const std::uint16_t> samples, std::span<const std::uint8_t> marks,
                     int width_px, double exposure_s);

// Pixels whose mean over the frames lies above its phase's median by more than six standard
// deviations of such a mean (std_counts: of a sample) and more than min_counts; ascending. sums:
// over n_frames frames.
std::vector<std::size_t> hot_pixels(std::span<const float> sums, int n_frames, int width_px,
                                    double std_counts, double min_counts);

// How uneven a dark frame is: the largest departure of a block's mean (of about 8 x 8 over the
// frame) from its phase's mean, in counts, and the standard deviation of one such mean.
struct Unevenness {
  double counts = 0;
  double std = 0;
};
Unevenness unevenness(std::span<const std::uint16_t> samples, std::span<const std::uint8_t> marks,
                      int width_px);

}  // namespace scattermeter::calib
