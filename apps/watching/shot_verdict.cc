#include "apps/watching/shot_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/checking/checked_rig.h"
#include "core/camera/cfa_samples.h"

namespace scattermeter::apps {
namespace {

constexpr double kAimedShare = 0.75;  // of the range, for the brightest patch
constexpr double kPaleShare = 0.25;   // below, a longer exposure is suggested
constexpr double kMostBlur_px = 2.0;
constexpr double kSharp_px = 0.2;
// The listed lights leave this much more of the image than the others do.
constexpr double kOtherLights = 2.0;

std::string time_text(double seconds) {
  return seconds < 0.3 ? fmt::format("1/{:.0f} s", 1.0 / seconds)
                       : fmt::format("{:.2g} s", seconds);
}

void judge_sharpness(const ObservedShot& shot, double fx_px, ShotVerdict& out) {
  if (!shot.edge_blur || !shot.edge_blur->is_measured) return;
  const double blur_mm = shot.edge_blur->largest_std_mm();
  const double blur_px = blur_mm / shot.px_mm(fx_px);
  const std::string text =
      blur_px < kSharp_px ? "edges sharp"
                          : fmt::format("edges blurred by {:.1f} px ({:.2f} mm)", blur_px, blur_mm);
  if (blur_px > kMostBlur_px) {
    out.problems.push_back("out of focus, or moved during the exposure: " + text +
                           "; focus on the object, and release without touching the camera");
  } else {
    out.remarks.push_back(text);
  }
}

void judge_outline(const LookedAtShot& shot, ShotVerdict& out) {
  if (!shot.look.outline) return;
  const double off_px = outline_off_px(shot.look);
  if (!shot.look.outline->agrees && !shot.earlier.empty() && off_px > 2.0 * shot.earlier_off_px) {
    out.problems.push_back(fmt::format(
        "camera or piece moved: the outline is {:.1f} px off, in {} it was {:.1f} px; put it back, "
        "or begin again with all shots",
        off_px, shot.earlier, shot.earlier_off_px));
  }
  out.remarks.push_back(fmt::format("outline {:.1f} px off", off_px));
}

}  // namespace

double outline_off_px(const FirstLook& look) {
  return look.outline ? look.outline->shift_px.norm() : 0.0;
}

ShotVerdict judge_exposure(const ObservedShot& shot, double range_counts) {
  ShotVerdict out;
  double clipped = 0.0, brightest_counts = 0.0, least_snr = std::numeric_limits<double>::infinity();
  std::size_t brightest = 0, darkest = 0, clipping = 0;
  for (std::size_t c = 0; c < kRgb; ++c) {
    const ChannelObservation& o = shot.observation.channel[c];
    const double share =
        static_cast<double>(o.samples_clipped) / std::max(1.0, static_cast<double>(o.samples));
    if (share > clipped) {
      clipped = share;
      clipping = c;
    }
    if (o.brightest_counts > brightest_counts) {
      brightest_counts = o.brightest_counts;
      brightest = c;
    }
    if (share < 1.0 && o.brightest_snr < least_snr) {
      least_snr = o.brightest_snr;
      darkest = c;
    }
  }
  const CheckOptions limits;  // as `check` has them
  const bool is_bracket = shot.exposures.size() > 1;
  if (100.0 * clipped > limits.max_clipped_percent) {
    // How far it clips is not seen; where much of it does, it is by more than a factor of two.
    const double factor = clipped > 0.3 ? 0.25 : 0.5;
    out.problems.push_back(fmt::format("overexposed: {:.0f} % of {}'s samples are clipped; {}",
                                       std::ceil(100.0 * clipped), kRgbName[clipping],
                                       is_bracket
                                           ? "add a shorter exposure to the bracket"
                                           : "take it at " + time_text(factor * shot.exposure_s)));
    return out;
  }
  const double share = brightest_counts / range_counts;
  const double longer = kAimedShare / std::max(share, 1e-4);
  if (least_snr < limits.min_brightest_snr) {
    out.problems.push_back(fmt::format(
        "too dark: {}'s brightest patch is {:.0f} times its noise; check that the LED was on{}",
        kRgbName[darkest], least_snr,
        is_bracket || longer < 1.5
            ? ""
            : ", or take it at " + time_text(std::min(longer, 100.0) * shot.exposure_s)));
    return out;
  }
  std::string remark = fmt::format("brightest patch at {:.0f} % of the range ({})", 100.0 * share,
                                   kRgbName[brightest]);
  if (share < kPaleShare && !is_bracket) {
    remark += "; less noise at " + time_text(longer * shot.exposure_s);
  }
  out.remarks.push_back(remark);
  return out;
}

ShotVerdict judge(const LookedAtShot& shot) {
  const ObservedShot& opened = shot.look.shots.front();
  ShotVerdict out = judge_exposure(opened, shot.range_counts);
  if (!out.is_accepted()) return out;
  judge_outline(shot, out);
  for (const Finding& f : shot.look.findings) {
    // The first is the outline's, if that does not agree.
    if (out.is_accepted() || &f != &shot.look.findings.front()) {
      out.problems.push_back(f.sentence());
    }
  }
  const ShotLikeness& likeness = shot.look.likeness.front();
  if (likeness.own > kDoubtfulImage && kOtherLights * likeness.best_other < likeness.own) {
    out.seen_lights = likeness.other_lights;
    out.problems.push_back(
        fmt::format("another light: the image looks {}, not lit by {}; switch on "
                    "what the rig lists",
                    likeness.other, fmt::join(opened.stated->lights, ", ")));
  }
  judge_sharpness(opened, shot.fx_px, out);
  return out;
}

}  // namespace scattermeter::apps
