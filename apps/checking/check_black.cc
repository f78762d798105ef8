#include <algorithm>
#include <array>
#include <cmath>

#include "apps/checking/check.h"
#include "core/base/median.h"

namespace scattermeter::apps {
namespace {

// By this many standard deviations of a block's mean the darkest tenth of the blocks may be off
// through noise and selection.
constexpr double kSelection = 4.0;

}  // namespace

std::vector<CheckItem> check_black(const CheckedRig& checked) {
  std::vector<CheckDetail> background, drift;
  const double read_noise = std::max(0.5, checked.rig.scene.camera.sensor.noise.read_noise_counts);
  for (std::size_t c = 0; c < kRgb; ++c) {
    std::vector<double> levels;  // of black itself, from the darkest background
    for (const CheckedFrame& frame : checked.frames) {
      if (frame.background.blocks > 0) {
        levels.push_back(frame.background.darkest_counts[c] + frame.black_counts[0]);
      }
    }
    if (levels.empty()) continue;
    const double usual = upper_median(levels);
    for (std::size_t i = 0; i < checked.shots.size(); ++i) {
      const capture::BackgroundLevel& b = checked.frames[i].background;
      if (b.blocks == 0) continue;
      const double brightest =
          std::max(1.0, checked.shots[i].observation.channel[c].brightest_counts);
      CheckDetail light = checked.of_channel(i, c, 100.0 * b.darkest_counts[c] / brightest);
      light.std = 100.0 * b.block_std_counts[c] / brightest;
      background.push_back(light);
      CheckDetail moved =
          checked.of_channel(i, c, b.darkest_counts[c] + checked.frames[i].black_counts[0] - usual);
      moved.std = b.block_std_counts[c];
      drift.push_back(moved);
    }
  }
  return {
      judged("background", "% of brightest",
             {checked.options.max_background_percent, false, false, kSelection},
             "look for a lamp left on, light on the lens, or a wrong black level", background),
      judged("black drift", "counts",
             {checked.options.max_black_drift_read_noises * read_noise, false, false, kSelection},
             "let the camera warm up, or look for a light that was on in some shots", drift)};
}

}  // namespace scattermeter::apps
