// What the light of the shots says about lights, files and units: LightLook::findings().
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/instrument/light_look.h"
#include "core/estimation/estimation.h"
#include "core/estimation/material_channel.h"

namespace scattermeter::apps {
namespace {

// Other lights must leave less than this share of the rest that the listed ones leave.
constexpr double kOtherRest = 0.5;
// Media whose rest is at most this many times the best, or this much more, are possible.
constexpr double kPossibleRatio = 1.3;
constexpr double kPossibleMore = 0.02;
constexpr double kExplained = 0.25;    // a scale is judged only where the rest is smaller
constexpr double kUnexplained = 0.35;  // an image with a larger rest is not that of the rig
constexpr double kFactor = 3.0;
constexpr double kPower = 0.35;  // a factor is a power of ten if its logarithm is this near
constexpr double kCoveredShare = 0.05;
constexpr double kScaleStds = 5.0;

using Lights = std::vector<std::string>;

std::string joined(const Lights& lights) { return fmt::format("{}", fmt::join(lights, " and ")); }

bool looks_other(const ShotLikeness& like) {
  return like.own > kDoubtfulImage && like.best_other < kOtherRest * like.own;
}

// "1000" or "0.25"
std::string number(double factor) {
  const double power = std::round(std::log10(factor));
  if (std::abs(std::log10(factor) - power) < kPower)
    return fmt::format("{:g}", std::pow(10, power));
  return fmt::format("{:.2g}", factor);
}

}  // namespace

std::size_t LightLook::index_of(std::size_t shot) const {
  return scene_.index_of(*shots_[shot].stated);
}

void LightLook::find_exchanged(const std::vector<ShotLikeness>& likeness,
                               std::vector<Finding>& out) const {
  // By stated lights: how many shots there are, and those that look lit by others.
  struct Setting {
    std::size_t shots = 0;
    std::map<Lights, std::vector<std::size_t>> others;
  };
  std::map<Lights, Setting> settings;
  for (std::size_t i = 0; i < shots_.size(); ++i) {
    if (!std::isfinite(likeness[i].own)) continue;
    Lights own = shots_[i].stated->lights;
    std::sort(own.begin(), own.end());
    ++settings[own].shots;
    if (looks_other(likeness[i])) settings[own].others[likeness[i].other_lights].push_back(i);
  }
  const auto all_look = [&](const Lights& own, const Lights& other) {
    const auto at = settings.find(own);
    return at != settings.end() && at->second.others.contains(other) &&
           at->second.others.at(other).size() == at->second.shots;
  };
  for (const auto& [own, setting] : settings) {
    for (const auto& [other, shots] : setting.others) {
      const bool both = all_look(own, other) && all_look(other, own);
      if (both && other < own) continue;  // told already
      Finding finding;
      for (const std::size_t i : shots) finding.shots.push_back(index_of(i));
      if (both) {
        for (const std::size_t i : settings.at(other).others.at(own)) {
          finding.shots.push_back(index_of(i));
        }
        finding.cause = "LEDs exchanged";
        finding.text = fmt::format(
            "LEDs exchanged: every shot listed as lit by {} looks lit by {}, and the reverse",
            joined(own), joined(other));
        finding.advice =
            "exchange them in lights or in shots.lights (or the files, if these were exchanged)";
      } else {
        std::string files;
        for (const std::size_t i : shots) {
          files += (files.empty() ? "" : ", ") + shots_[i].stated->file;
        }
        const bool has_more = std::includes(other.begin(), other.end(), own.begin(), own.end());
        finding.cause = has_more ? "another LED on" : "file exchanged";
        finding.text = fmt::format(
            "{}: {} looks lit by {}, not by {} ({:.0f} instead of {:.0f} % of the image "
            "unexplained)",
            has_more ? "another LED on" : "file exchanged, or wrong lights", files, joined(other),
            joined(own) + (has_more ? " alone" : ""), 100.0 * likeness[shots.front()].best_other,
            100.0 * likeness[shots.front()].own);
        finding.advice = has_more ? "switch it off and take the shot again, or list it in "
                                    "shots.lights"
                                  : "give the files their right names, or correct shots.lights";
      }
      out.push_back(finding);
    }
  }
}

void LightLook::find_covered(const std::vector<ShotLikeness>& likeness,
                             std::vector<Finding>& out) const {
  for (std::size_t i = 0; i < shots_.size(); ++i) {
    if (!(likeness[i].own > kDoubtfulImage) || looks_other(likeness[i])) continue;
    const double share = covered_share(i, best_channel(shots_[i].observation));
    const std::string& file = shots_[i].stated->file;
    Finding finding;
    finding.shots = {index_of(i)};
    if (share > kCoveredShare) {
      finding.cause = "object covered";
      finding.text = fmt::format(
          "object covered or shadowed: {:.0f} % of the patches that {} lights are dark in {}",
          100.0 * share, joined(shots_[i].stated->lights), file);
      finding.advice =
          "remove what stands before the object or its light, or put the object where its mesh is, "
          "and take the shot again";
    } else if (likeness[i].own > kUnexplained) {
      finding.cause = "image not explained";
      finding.text = fmt::format(
          "image not explained: {:.0f} % of {} does not fit any material on this object under {}",
          100.0 * likeness[i].own, file, joined(shots_[i].stated->lights));
      finding.advice = "compare the shot with mesh, pose and lights of the rig (`check`)";
    } else {
      continue;
    }
    out.push_back(finding);
  }
}

void LightLook::find_factors(const std::vector<ShotLikeness>& likeness,
                             std::vector<Finding>& out) const {
  const double std = scale_prior(scene_).relative_std;
  if (!std::isfinite(std)) return;
  const double least = std::max(kFactor, 1.0 + kScaleStds * std);
  // By lights: the logarithms of the factors, and the number of images judged.
  struct Setting {
    std::size_t images = 0;
    std::vector<double> logs;
    std::set<std::size_t> shots;
    // Factors that some medium allows.
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
  };
  std::map<Lights, Setting> settings;
  for (std::size_t i = 0; i < shots_.size(); ++i) {
    const ObservedShot& shot = shots_[i];
    if (!(likeness[i].own < kExplained)) continue;
    for (std::size_t c = 0; c < kRgb; ++c) {
      if (!shot_problem(shot, c).empty()) continue;
      const Match m = match(*shot.seen, shot.observation.channel[c], shot.stated->lights, c);
      if (!std::isfinite(m.rest)) continue;
      double low = std::numeric_limits<double>::infinity();
      double high = 0.0;
      for (Eigen::Index k = 0; k < m.rests.size(); ++k) {
        if (m.rests[k] > std::max(kPossibleRatio * m.rest, m.rest + kPossibleMore)) continue;
        low = std::min(low, m.scales[k]);
        high = std::max(high, m.scales[k]);
      }
      Setting& setting = settings[shot.stated->lights];
      ++setting.images;
      setting.low = std::min(setting.low, low);
      setting.high = std::max(setting.high, high);
      setting.shots.insert(index_of(i));
      if (low > least || high * least < 1.0) {
        setting.logs.push_back(0.5 * (std::log(low) + std::log(high)));
      }
    }
  }
  Lights off;
  Finding finding;
  double sum = 0.0;
  double n = 0.0;
  for (const auto& [lights, setting] : settings) {
    if (2 * setting.logs.size() <= setting.images) continue;
    off.push_back(joined(lights));
    for (const double v : setting.logs) sum += v;
    n += static_cast<double>(setting.logs.size());
    finding.shots.insert(finding.shots.end(), setting.shots.begin(), setting.shots.end());
  }
  if (off.empty()) return;
  const double factor = std::exp(sum / n);
  // Other lights for which some medium allows the same factor are most likely off as well.
  const bool all = std::all_of(settings.begin(), settings.end(), [&](const auto& setting) {
    return factor > setting.second.low / kFactor && factor < setting.second.high * kFactor;
  });
  const bool thousand = std::abs(std::abs(std::log10(factor)) - 3.0) < kPower;
  finding.cause = thousand ? "unit: mW for W" : "light off by a factor";
  finding.text = fmt::format(
      "{}: {} {} times {} light than the stated intensities and responsivity allow for any "
      "material",
      thousand ? (factor < 1.0 ? "unit (mW for W?)" : "unit (W for mW?)") : "light off by a factor",
      all ? "the shots contain"
          : "the shots lit by " + fmt::format("{}", fmt::join(off, ", ")) + " contain",
      number(std::max(factor, 1.0 / factor)), factor < 1.0 ? "less" : "more");
  finding.advice = all ? "correct lights.intensity_W_per_sr (in W/sr) or "
                         "camera.responsivity_counts_mm2_sr_per_W_s"
                       : std::string(factor < 1.0 ? "see that they were on, or " : "") +
                             "correct the intensity_W_per_sr of these lights";
  out.push_back(finding);
}

std::vector<Finding> LightLook::findings() {
  std::vector<ShotLikeness> likeness_of;
  for (std::size_t i = 0; i < shots_.size(); ++i) likeness_of.push_back(likeness(i));
  std::vector<Finding> out;
  find_exchanged(likeness_of, out);
  find_covered(likeness_of, out);
  find_factors(likeness_of, out);
  return out;
}

}  // namespace scattermeter::apps
