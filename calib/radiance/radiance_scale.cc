// Glare, vignetting and the scale.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "calib/radiance/glare_fit.h"
#include "calib/radiance/radiance_steps.h"
#include "calib/radiance/vignetting_fit.h"
#include "calib/radiance/white_pixels.h"
#include "calib/radiance/white_scale.h"
#include "capture/sensor/corrected_samples.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

constexpr double kMaxClippedGlare = 1e-3;  // of the frame: its mean must be known
constexpr double kMaxTrapShare = 0.3;      // of the frame's mean, in a trap
constexpr double kMaxClippedWhite = 0.01;  // of the plane

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

// Relative standard deviation of the plane's mean radiance by what the rig does not know of its
// LED.
double led_relative_std(const WhiteReference& white, const PriorLed& light,
                        const std::vector<WhitePixel>& pixels) {
  const Eigen::Vector3d normal = white.plane.normal();
  const auto mean = [&](const Led& led) {
    double sum = 0;
    const std::size_t step = std::max<std::size_t>(1, pixels.size() / 500);
    for (std::size_t i = 0; i < pixels.size(); i += step) {
      sum += white_radiance_per_intensity(led, pixels[i].point_mm, normal);
    }
    return sum;
  };
  const double nominal = mean(light.led);
  double variance = light.power_relative_std * light.power_relative_std;
  for (int k = 0; k < 3 && light.position_std_mm > 0.0; ++k) {
    Led moved = light.led;
    moved.position_mm[k] += light.position_std_mm;
    variance += std::pow(mean(moved) / nominal - 1.0, 2);
  }
  if (light.exponent_std > 0.0) {
    Led other = light.led;
    other.exponent += light.exponent_std;
    variance += std::pow(mean(other) / nominal - 1.0, 2);
  }
  return std::sqrt(variance);
}

// Standard deviation of the shots' mean log light by the curve and the exposure times, which the
// flats gave together.
double log_light_std(const RadianceSteps& steps,
                     const std::vector<std::pair<double, double>>& levels,
                     const std::vector<WhiteSum>& sums) {
  const std::vector<double>& knots = steps.calibration.correction.response[0].knot_counts();
  const auto n = static_cast<Eigen::Index>(steps.settings_s.size());
  Eigen::RowVectorXd a = Eigen::RowVectorXd::Zero(steps.response_covariance.rows());
  double total = 0, elsewhere = 0, single = 0;
  for (const WhiteSum& s : sums) total += white_weight(s);
  if (!(total > 0.0)) return 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double share = white_weight(sums[i]) / total;
    a.tail(a.size() - n) += share * ResponseCurve::weights(knots, levels[i].second);
    const auto setting =
        std::find_if(steps.settings_s.begin(), steps.settings_s.end(),
                     [&](double t) { return std::abs(t - levels[i].first) <= 1e-3 * t; });
    if (setting == steps.settings_s.end()) {
      elsewhere += share * steps.calibration.correction.shutter_relative_std;
    } else {
      a[setting - steps.settings_s.begin()] -= share;
    }
    single += share * share * steps.shot_std * steps.shot_std;
  }
  const double variance = (a * steps.response_covariance * a.transpose()).value();
  return std::sqrt(std::max(0.0, variance) + elsewhere * elsewhere + single);
}

}  // namespace

void find_glare(RadianceSteps& steps) {
  const std::optional<GlareTarget>& glare = steps.input.shots.glare;
  capture::RadianceCalibration& calibration = steps.calibration;
  capture::RadianceCorrection& correction = calibration.correction;
  if (!glare) {
    calibration.notes.emplace_back("no glare shot: stray light is taken for none");
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
      // Neither glare nor vignetting is in the correction yet.
      const capture::CorrectedSamples s =
          capture::corrected_samples(frame, correction, r.x0, r.y0, r.width, r.height);
      for (std::size_t c = 0; c < kRgb; ++c) {
        const TrapMean trap =
            trap_mean(s.samples, c, correction.black_std_counts, s.frame_mean_counts[c]);
        if (!(trap.frame_counts > 0.0) || trap.counts > kMaxTrapShare * trap.frame_counts) {
          throw InputError(
              shot.file,
              fmt::format(
                  "glare: the trap at [{}, {}] holds {:.1f} counts in channel {}, the frame "
                  "{:.1f} in the mean; is the rectangle on a black trap, and is there light?",
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

void find_vignetting(RadianceSteps& steps) {
  capture::RadianceCalibration& calibration = steps.calibration;
  capture::RadianceCorrection& correction = calibration.correction;
  std::array<double, kRgb> sum{}, n{};
  for (std::size_t k = 0; k < steps.blocks.size(); ++k) {
    const auto c =
        static_cast<std::size_t>(steps.cfa.phase[static_cast<std::size_t>(steps.blocks[k].phase)]);
    if (!(steps.light[k].per_s > 0.0)) continue;
    sum[c] += steps.light[k].per_s * steps.light[k].samples;
    n[c] += steps.light[k].samples;
  }
  std::vector<FlatLight> lights;
  for (std::size_t k = 0; k < steps.blocks.size(); ++k) {
    const RadianceSteps::Light& l = steps.light[k];
    if (!(l.per_s > 0.0)) continue;
    const auto c =
        static_cast<std::size_t>(steps.cfa.phase[static_cast<std::size_t>(steps.blocks[k].phase)]);
    lights.push_back({steps.blocks[k], c, l.per_s - correction.glare_share[c] * sum[c] / n[c],
                      l.relative_variance * l.per_s * l.per_s, l.shared});
  }
  const VignettingFit fit = fit_vignetting(lights, correction.width_px, correction.height_px);
  if (!fit.ok) {
    throw InputError(steps.input.shots.at(steps.input.shots.line) + ": calibration.radiance.flats",
                     fmt::format("vignetting: {} of {} blocks of the frame are usable, too few",
                                 lights.size(), steps.blocks.size()));
  }
  correction.vignetting = fit.vignetting;
  correction.vignetting_std = fit.rms_std;
  calibration.residuals.push_back({"flat field against vignetting", std::sqrt(fit.reduced_chi2),
                                   100.0 * fit.worst, 2.0, "standard deviations (worst: %)"});
}

void find_scale(RadianceSteps& steps) {
  const std::optional<WhiteReference>& white = steps.input.shots.white;
  capture::RadianceCalibration& calibration = steps.calibration;
  const capture::RadianceCorrection& correction = calibration.correction;
  if (!white) {
    calibration.notes.emplace_back("no white reference: the responsivity stays open");
    return;
  }
  const PriorLed& light = *steps.input.white_led;
  std::array<std::vector<WhiteSum>, kRgb> sums;
  std::vector<WhitePixel> pixels;
  const Eigen::Vector3d normal = white->plane.normal();
  std::vector<std::pair<double, double>> levels;  // stated time and counts of each shot used
  std::string last_problem = "no shot of it";
  for (const RadianceShot& shot : white->shots) {
    const capture::RawFrame frame = open_radiance_shot(steps, shot);
    if (pixels.empty()) {
      const PoseResult pose = steps.input.pose.estimate(frame, shot.file);
      pixels = white_pixels(white->plane, {steps.input.intrinsics, pose.camera_from_world},
                            0.05 * std::min(white->plane.width_mm, white->plane.height_mm));
      if (pixels.size() < 400) {
        throw InputError(
            steps.input.shots.at(white->line) + ": calibration.radiance.white",
            fmt::format("the plane fills {} pixels of {}, at least 400 wanted; look at "
                        "origin_mm, the axes and the pose",
                        pixels.size(), shot.file));
      }
    }
    const capture::CorrectedSamples s =
        capture::corrected_samples(frame, correction, 0, 0, frame.width_px, frame.height_px);
    std::array<WhiteSum, kRgb> sum{};
    double clipped = 0, signal = 0;
    for (const WhitePixel& p : pixels) {
      if (s.samples.clipped[p.pixel] == kSampleClipped) clipped += 1.0;
      if (s.samples.clipped[p.pixel] != 0) continue;
      const auto width = static_cast<std::size_t>(frame.width_px);
      const auto c = static_cast<std::size_t>(
          s.samples.channel(static_cast<int>(p.pixel % width), static_cast<int>(p.pixel / width)));
      const double exposure_s = s.samples.exposure_s;
      sum[c].counts_per_s += static_cast<double>(s.samples.signal_counts[p.pixel]) / exposure_s;
      sum[c].variance +=
          static_cast<double>(s.samples.variance_counts2[p.pixel]) / (exposure_s * exposure_s);
      sum[c].radiance += white->plane.albedo[static_cast<Eigen::Index>(c)] *
                         light.led.intensity_W_per_sr[static_cast<Eigen::Index>(c)] *
                         white_radiance_per_intensity(light.led, p.point_mm, normal);
      signal += static_cast<double>(s.samples.signal_counts[p.pixel]);
    }
    clipped /= static_cast<double>(pixels.size());
    if (clipped > kMaxClippedWhite) {
      last_problem = fmt::format(
          "{:.1f} % of its samples are clipped, limit {:.0f} %; expose "
          "shorter",
          100.0 * clipped, 100.0 * kMaxClippedWhite);
      calibration.notes.push_back(shot.file + ": left out, " + last_problem);
      continue;
    }
    const double mean_counts = signal / static_cast<double>(pixels.size());
    levels.emplace_back(frame.exposure_s, mean_counts);
    for (std::size_t c = 0; c < kRgb; ++c) {
      // Black and glare are common to the shot's samples.
      const double glare = correction.glare_std[c] * s.frame_mean_counts[c];
      sum[c].relative_std = std::hypot(s.black_std_counts, glare) / mean_counts;
      sums[c].push_back(sum[c]);
    }
  }
  calibration.responsivity.emplace();
  double statistical = 0, worst = 0;
  for (std::size_t c = 0; c < kRgb; ++c) {
    const WhiteScale scale = fit_white_scale(sums[c]);
    if (!scale.ok) {
      throw InputError(white->shots.front().file,
                       fmt::format("white reference, channel {}: {}", kRgbName[c], last_problem));
    }
    (*calibration.responsivity)[c] = scale.responsivity;
    statistical = std::max(statistical, scale.relative_std);
    worst = std::max(worst, scale.worst);
  }
  const double light_std = log_light_std(steps, levels, sums[1]);
  double variance = 0;
  for (const double std :
       {statistical, white->plane.albedo_relative_std, led_relative_std(*white, light, pixels),
        correction.vignetting_std, light_std}) {
    variance += std * std;
  }
  calibration.responsivity_relative_std = std::sqrt(variance);
  calibration.residuals.push_back(
      {"white reference, shots of the bracket", 100.0 * worst, 100.0 * worst, 0.5, "%"});
}

}  // namespace scattermeter::calib
