// The responsivity from a white reference.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/core.h>

#include "calib/radiance/radiance_steps.h"
#include "calib/radiance/white_pixels.h"
#include "calib/radiance/white_scale.h"
#include "capture/sensor/corrected_samples.h"
#include "core/base/input_error.h"

namespace scattermeter::calib {
namespace {

constexpr double kMaxClippedWhite = 0.01;  // of the plane

// Relative standard deviation of the plane's mean radiance due to the uncertainty of the LED.
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
  const LedUncertainty u = uncertainty_of(light);
  const LedVector std = u.covariance.diagonal().cwiseSqrt();
  LedVector by = LedVector::Zero();  // relative change by each parameter, over a deviation of it
  for (Eigen::Index k = 0; k < kLedLogIntensity; ++k) {
    if (!(std[k] > 0.0)) continue;
    Led other = light.led;
    if (k < kLedAxis) {
      other.position_mm[k] += std[k];
    } else if (k < kLedExponent) {
      const auto tangent = static_cast<std::size_t>(k - kLedAxis);
      other.axis = (other.axis + std[k] * u.tangents[tangent]).normalized();
    } else {
      other.exponent += std[k];
    }
    by[k] = (mean(other) / nominal - 1.0) / std[k];
  }
  double most = 0.0;  // of the channels
  for (Eigen::Index c = 0; c < 3; ++c) {
    LedVector own = by;
    own[kLedLogIntensity + c] = 1.0;
    most = std::max(most, own.dot(u.covariance * own));
  }
  return std::sqrt(most);
}

// Exposure and mean level of a shot of the plane.
struct WhiteLevel {
  double stated_s;
  double counts;  // mean over the plane
};

// Standard deviation of the shots' mean log light due to the curve and the exposure times, whose
// errors are correlated as both are from the flats.
double log_light_std(const RadianceSteps& steps, const std::vector<WhiteLevel>& levels,
                     const std::vector<WhiteSum>& sums) {
  const std::vector<double>& knots = steps.calibration.correction.response[0].knot_counts();
  const auto n = static_cast<Eigen::Index>(steps.settings_s.size());
  Eigen::RowVectorXd a = Eigen::RowVectorXd::Zero(steps.response_covariance.rows());
  double total = 0, elsewhere = 0, single = 0;
  for (const WhiteSum& s : sums) total += white_weight(s);
  if (!(total > 0.0)) return 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double share = white_weight(sums[i]) / total;
    a.tail(a.size() - n) += share * ResponseCurve::weights(knots, levels[i].counts);
    const auto setting =
        std::find_if(steps.settings_s.begin(), steps.settings_s.end(),
                     [&](double t) { return std::abs(t - levels[i].stated_s) <= 1e-3 * t; });
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

std::vector<WhitePixel> pixels_of_white(const RadianceSteps& steps, const WhiteReference& white,
                                        const capture::RawFrame& frame, const std::string& file) {
  const PoseResult pose = steps.input.pose.estimate(frame, file);
  std::vector<WhitePixel> pixels =
      white_pixels(white.plane, {steps.input.intrinsics, pose.camera_from_world},
                   0.05 * std::min(white.plane.width_mm, white.plane.height_mm));
  if (pixels.size() < 400) {
    throw InputError(steps.input.shots.at(white.line) + ": calibration.radiance.white",
                     fmt::format("the plane fills {} pixels of {}, at least 400 are needed; check "
                                 "origin_mm, the axes and the pose",
                                 pixels.size(), file));
  }
  return pixels;
}

// One shot of the plane, summed over its pixels.
struct WhiteShot {
  std::array<WhiteSum, kRgb> sums{};
  double clipped_share = 0;
  double mean_counts = 0;
};

WhiteShot sum_white(const capture::CorrectedSamples& s, const WhiteReference& white, const Led& led,
                    const std::vector<WhitePixel>& pixels,
                    const std::array<double, kRgb>& glare_std) {
  WhiteShot shot;
  const CfaSamples& samples = s.samples;
  const Eigen::Vector3d normal = white.plane.normal();
  const auto width = static_cast<std::size_t>(samples.width);
  const double exposure_s = samples.exposure_s;
  double clipped = 0, signal = 0;
  for (const WhitePixel& p : pixels) {
    if (samples.clipped[p.pixel] == kSampleClipped) clipped += 1.0;
    if (samples.clipped[p.pixel] != 0) continue;
    const auto c = static_cast<std::size_t>(
        samples.channel(static_cast<int>(p.pixel % width), static_cast<int>(p.pixel / width)));
    WhiteSum& sum = shot.sums[c];
    sum.counts_per_s += static_cast<double>(samples.signal_counts[p.pixel]) / exposure_s;
    sum.variance +=
        static_cast<double>(samples.variance_counts2[p.pixel]) / (exposure_s * exposure_s);
    sum.radiance += white.plane.albedo[static_cast<Eigen::Index>(c)] *
                    led.intensity_W_per_sr[static_cast<Eigen::Index>(c)] *
                    white_radiance_per_intensity(led, p.point_mm, normal);
    signal += static_cast<double>(samples.signal_counts[p.pixel]);
  }
  shot.clipped_share = clipped / static_cast<double>(pixels.size());
  shot.mean_counts = signal / static_cast<double>(pixels.size());
  for (std::size_t c = 0; c < kRgb; ++c) {
    // Errors of black and glare are common to the samples of the shot.
    const double glare = glare_std[c] * s.frame_mean_counts[c];
    shot.sums[c].relative_std = std::hypot(s.black_std_counts, glare) / shot.mean_counts;
  }
  return shot;
}

}  // namespace

void find_scale(RadianceSteps& steps) {
  const std::optional<WhiteReference>& white = steps.input.shots.white;
  capture::RadianceCalibration& calibration = steps.calibration;
  const capture::RadianceCorrection& correction = calibration.correction;
  if (!white) {
    calibration.notes.emplace_back("no white reference: the responsivity is not determined");
    return;
  }
  const PriorLed& light = *steps.input.white_led;
  std::array<std::vector<WhiteSum>, kRgb> sums;
  std::vector<WhitePixel> pixels;
  std::vector<WhiteLevel> levels;  // of the shots used
  std::string last_problem = "no shot of it";
  for (const RadianceShot& shot : white->shots) {
    const capture::RawFrame frame = open_radiance_shot(steps, shot);
    if (pixels.empty()) pixels = pixels_of_white(steps, *white, frame, shot.file);
    const WhiteShot seen = sum_white(
        capture::corrected_samples(frame, correction, 0, 0, frame.width_px, frame.height_px),
        *white, light.led, pixels, correction.glare_std);
    if (seen.clipped_share > kMaxClippedWhite) {
      last_problem = fmt::format(
          "{:.1f} % of its samples are clipped, limit {:.0f} %; expose "
          "shorter",
          100.0 * seen.clipped_share, 100.0 * kMaxClippedWhite);
      calibration.notes.push_back(shot.file + ": left out, " + last_problem);
      continue;
    }
    levels.push_back({frame.exposure_s, seen.mean_counts});
    for (std::size_t c = 0; c < kRgb; ++c) sums[c].push_back(seen.sums[c]);
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
