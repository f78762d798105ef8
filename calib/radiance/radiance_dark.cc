// Dark frames: black, dark current, hot pixels.
#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "calib/radiance/dark_fit.h"
#include "calib/radiance/radiance_steps.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

constexpr double kMaxDarkShare = 0.02;       // most of the range that dark current may fill
constexpr double kMaxUneven_counts = 0.5;    // of a block of an eighth of the frame
constexpr double kMaxDarkStep_counts = 3.0;  // of one frame from the others

void refuse_lit(const RadianceShot& shot, const std::string& what) {
  throw InputError(
      shot.file,
      "dark frame: " + what + "; was a light on, or the lens cap off? Take it again in the dark");
}

void check_dark(const RadianceShot& shot, const capture::RawFrame& frame, const DarkFrame& dark) {
  for (std::size_t p = 0; p < 4; ++p) {
    const double excess = dark.mean_counts[p] - frame.black_counts[p];
    const double limit = kMaxDarkShare * (frame.white_counts - frame.black_counts[p]);
    if (excess > limit) {
      refuse_lit(shot,
                 fmt::format("its mean lies {:.1f} counts above the file's black, limit {:.1f}",
                             excess, limit));
    }
  }
}

}  // namespace

void find_dark(RadianceSteps& steps) {
  const std::vector<RadianceShot>& shots = steps.input.shots.dark;
  capture::RadianceCalibration& calibration = steps.calibration;
  capture::RadianceCorrection& correction = calibration.correction;
  // Hot pixels first, from the frames with the longest exposure, in which they are brightest.
  std::vector<float> sums;
  double longest_s = 0, sample_std = 0;
  int n_longest = 0;
  for (const RadianceShot& shot : shots) {
    const capture::RawFrame frame = open_radiance_shot(steps, shot);
    const std::vector<std::uint8_t> none(frame.samples.size(), 0);
    const DarkFrame dark = dark_frame(frame.samples, none, frame.width_px, frame.exposure_s);
    check_dark(shot, frame, dark);
    if (frame.exposure_s > 1.1 * longest_s) {
      longest_s = frame.exposure_s;
      n_longest = 0;
      sums.assign(frame.samples.size(), 0.0F);
    } else if (frame.exposure_s < longest_s / 1.1) {
      continue;
    }
    ++n_longest;
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += static_cast<float>(frame.samples[i]);
    sample_std = dark.std_of_mean[0] * std::sqrt(0.25 * static_cast<double>(frame.samples.size()));
  }
  constexpr double kLeastHot_counts = 2.0;
  correction.defect_pixels =
      hot_pixels(sums, n_longest, correction.width_px, sample_std, kLeastHot_counts);
  if (static_cast<double>(correction.defect_pixels.size()) >
      0.05 * static_cast<double>(sums.size())) {
    throw InputError(
        shots.front().file,
        fmt::format("dark frames: {} of {} pixels are hot; light on part of the frame?",
                    correction.defect_pixels.size(), sums.size()));
  }
  std::vector<DarkFrame> frames;
  for (const RadianceShot& shot : shots) {
    const capture::RawFrame frame = open_radiance_shot(steps, shot);
    std::vector<std::uint8_t> marks(frame.samples.size(), 0);
    for (const std::size_t i : correction.defect_pixels) marks[i] = kSampleDefect;
    const Unevenness uneven = unevenness(frame.samples, marks, frame.width_px);
    if (uneven.counts > std::max(kMaxUneven_counts, 6.0 * uneven.std)) {
      refuse_lit(shot, fmt::format("parts of it differ by {:.2f} counts, limit {:.2f}",
                                   uneven.counts, std::max(kMaxUneven_counts, 6.0 * uneven.std)));
    }
    frames.push_back(dark_frame(frame.samples, marks, frame.width_px, frame.exposure_s));
  }
  const DarkFit fit = fit_dark(frames);
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (std::abs(fit.residual_counts[i]) >= fit.worst_counts &&
        fit.worst_counts > kMaxDarkStep_counts) {
      refuse_lit(shots[i], fmt::format("its mean is {:+.2f} counts off those of the others, limit "
                                       "{:.1f}",
                                       fit.residual_counts[i], kMaxDarkStep_counts));
    }
  }
  correction.black_counts = fit.black_counts;
  correction.dark_counts_per_s = fit.dark_counts_per_s;
  correction.black_std_counts = fit.black_std_counts;
  if (!fit.rate_known) {
    calibration.notes.emplace_back(
        "all dark frames have the same exposure time: dark current counts as black level and is "
        "assumed not to grow with time; take some that are at least twice as long");
  }
  if (!fit.scatter_known) {
    calibration.notes.emplace_back(
        "too few dark frames to see the black level drift: shoot four or more");
  }
  calibration.residuals.push_back({"dark frames", fit.rms_counts, fit.worst_counts, 1.0, "counts"});
}

}  // namespace scattermeter::calib
