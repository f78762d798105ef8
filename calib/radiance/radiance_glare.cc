// Glare from black traps.
#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/core.h>

#include "calib/radiance/glare_fit.h"
#include "calib/radiance/radiance_steps.h"
#include "capture/sensor/corrected_samples.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

constexpr double kMaxClippedGlare = 1e-3;  // share of the frame, whose mean must be known
constexpr double kMaxTrapShare = 0.3;      // of the frame mean, in a trap

double clipped_share(const capture::RawFrame& frame,
                     const capture::RadianceCorrection& correction) {
  const std::vector<std::uint8_t> marks = marks_of(frame, correction);
  return static_cast<double>(std::count(marks.begin(), marks.end(), kSampleClipped)) /
         static_cast<double>(marks.size());
}

TrapMean trap_mean(const CfaSamples& samples, std::size_t colour, double black_std,
                   double frame_counts) {
  double sum = 0, variance = 0, n = 0;
  std::size_t i = 0;
  for (int y = samples.y0; y < samples.y0 + samples.height; ++y) {
    for (int x = samples.x0; x < samples.x0 + samples.width; ++x, ++i) {
      if (samples.channel(x, y) != static_cast<int>(colour) || samples.clipped[i] != 0) continue;
      sum += static_cast<double>(samples.signal_counts[i]);
      variance += static_cast<double>(samples.variance_counts2[i]);
      n += 1.0;
    }
  }
  if (!(n > 0.0)) return {0.0, 1.0, 0.0};
  return {sum / n, std::hypot(std::sqrt(variance) / n, black_std), frame_counts};
}

}  // namespace

void find_glare(RadianceSteps& steps) {
  const std::optional<GlareTarget>& glare = steps.input.shots.glare;
  capture::RadianceCalibration& calibration = steps.calibration;
  capture::RadianceCorrection& correction = calibration.correction;
  if (!glare) {
    calibration.notes.emplace_back("no glare shot: stray light is assumed to be zero");
    return;
  }
  std::array<std::vector<TrapMean>, kRgb> traps;
  for (const RadianceShot& shot : glare->shots) {
    const capture::RawFrame frame = open_radiance_shot(steps, shot);
    const double clipped = clipped_share(frame, correction);
    if (clipped > kMaxClippedGlare) {
      throw InputError(shot.file, fmt::format("glare: {:.2f} % of the samples are clipped, limit "
                                              "{:.2f} %; expose shorter",
                                              100.0 * clipped, 100.0 * kMaxClippedGlare));
    }
    for (const PixelRect& r : glare->traps_px) {
      if (r.x0 + r.width > frame.width_px || r.y0 + r.height > frame.height_px) {
        throw InputError(
            steps.input.shots.at(glare->line) + ": calibration.radiance.glare.traps_px",
            fmt::format("[{}, {}, {}, {}] leaves the frame of {} x {}", r.x0, r.y0, r.width,
                        r.height, frame.width_px, frame.height_px));
      }
      // The correction does not contain glare and vignetting yet.
      const capture::CorrectedSamples s =
          capture::corrected_samples(frame, correction, r.x0, r.y0, r.width, r.height);
      for (std::size_t c = 0; c < kRgb; ++c) {
        const TrapMean trap =
            trap_mean(s.samples, c, correction.black_std_counts, s.frame_mean_counts[c]);
        if (!(trap.frame_counts > 0.0) || trap.counts > kMaxTrapShare * trap.frame_counts) {
          throw InputError(
              shot.file,
              fmt::format("glare: the trap at [{}, {}] has {:.1f} counts in channel {}, the frame "
                          "a mean of {:.1f}; is the rectangle on a black trap, and is there light?",
                          r.x0, r.y0, trap.counts, kRgbName[c], trap.frame_counts));
        }
        traps[c].push_back(trap);
      }
    }
  }
  double rms = 0, worst = 0;
  for (std::size_t c = 0; c < kRgb; ++c) {
    const GlareFit fit = fit_glare(traps[c], glare->relative_std);
    correction.glare_share[c] = fit.share;
    correction.glare_std[c] = fit.std;
    rms = std::max(rms, fit.rms_counts);
    worst = std::max(worst, fit.worst_counts);
  }
  calibration.residuals.push_back({"glare in the traps", rms, worst, 5.0, "counts"});
}

}  // namespace scattermeter::calib
