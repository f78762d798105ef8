// What the light of the shots says about lights, files and units: LightLook::findings().
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/core.h>
#include <fmt/format.h>

#include "apps/looks/light_look.h"
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

// Adds those of the images that are off if most are; whether they are.
template <class Image>
bool add_if_most_are_off(const std::vector<Image>& images, std::vector<Image>& off) {
  const auto is_off = [](const Image& image) { return image.is_off; };
  const auto n = std::count_if(images.begin(), images.end(), is_off);
  if (2 * n <= std::ssize(images)) return false;
  std::copy_if(images.begin(), images.end(), std::back_inserter(off), is_off);
  return true;
}

// "1000", "400" or "0.25"
std::string number(double factor) {
  const double power = std::round(std::log10(factor));
  if (std::abs(std::log10(factor) - power) < kPower)
    return fmt::format("{:g}", std::pow(10, power));
  return factor < 100.0 ? fmt::format("{:.2g}", factor)
                        : fmt::format("{:.0f}", 10.0 * std::round(factor / 10.0));
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
      // The outlines of others show where they stand.
      const char* elsewhere = shots_[i].seen->object->is_round
                                  ? ", or the object is not where or as large as its mesh"
                                  : "";
      finding.text = fmt::format(
          "object covered or shadowed: {:.0f} % of the patches that {} lights are dark in {}{}",
          100.0 * share, joined(shots_[i].stated->lights), file, elsewhere);
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

// The factors by which an image may be brighter than the rig states, for media that look like it.
struct LightLook::PossibleFactors {
  Lights lights;
  std::size_t channel = 0, shot_idx = 0;
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  bool is_off = false;
};

std::vector<LightLook::PossibleFactors> LightLook::possible_factors(
    const std::vector<ShotLikeness>& likeness) const {
  const double std = scale_prior(scene_).relative_std;
  std::vector<PossibleFactors> out;
  if (!std::isfinite(std)) return out;
  const double least = std::max(kFactor, 1.0 + kScaleStds * std);
  for (std::size_t i = 0; i < shots_.size(); ++i) {
    const ObservedShot& shot = shots_[i];
    if (!(likeness[i].own < kExplained)) continue;
    for (std::size_t c = 0; c < kRgb; ++c) {
      if (!shot_problem(shot, c).empty()) continue;
      const Match m = match(*shot.seen, shot.observation.channel[c], shot.stated->lights, c);
      if (!std::isfinite(m.rest)) continue;
      PossibleFactors image{shot.stated->lights, c, index_of(i)};
      for (Eigen::Index k = 0; k < m.rests.size(); ++k) {
        if (m.rests[k] > std::max(kPossibleRatio * m.rest, m.rest + kPossibleMore)) continue;
        image.low = std::min(image.low, m.scales[k]);
        image.high = std::max(image.high, m.scales[k]);
      }
      if (!(image.high > 0.0)) continue;  // lights without power in the channel
      image.is_off = image.low > least || image.high * least < 1.0;
      out.push_back(image);
    }
  }
  return out;
}

void LightLook::find_factors(const std::vector<ShotLikeness>& likeness,
                             std::vector<Finding>& out) const {
  const std::vector<PossibleFactors> images = possible_factors(likeness);
  std::map<Lights, std::vector<PossibleFactors>> by_lights;
  std::map<std::size_t, std::vector<PossibleFactors>> by_channel;
  for (const PossibleFactors& image : images) {
    by_lights[image.lights].push_back(image);
    by_channel[image.channel].push_back(image);
  }
  std::vector<PossibleFactors> off;
  std::vector<std::string> names;  // of the lights or else the channels that are off
  for (const auto& [lights, own] : by_lights) {
    if (add_if_most_are_off(own, off)) names.push_back(joined(lights));
  }
  const bool is_of_channels = off.empty();
  for (const auto& [channel, own] : by_channel) {
    if (is_of_channels && add_if_most_are_off(own, off)) {
      names.emplace_back(1, kRgbName.at(channel));
    }
  }
  if (off.empty()) return;
  double sum = 0.0;
  std::set<std::size_t> shots;
  for (const PossibleFactors& image : off) {
    sum += 0.5 * (std::log(image.low) + std::log(image.high));
    shots.insert(image.shot_idx);
  }
  const double factor = std::exp(sum / static_cast<double>(off.size()));
  // Other lights for which some medium allows the same factor are most likely off as well.
  const bool all =
      !is_of_channels && std::all_of(by_lights.begin(), by_lights.end(), [&](const auto& setting) {
        const auto allows = [&](const PossibleFactors& image) {
          return factor > image.low / kFactor && factor < image.high * kFactor;
        };
        return std::any_of(setting.second.begin(), setting.second.end(), allows);
      });
  const bool thousand = std::abs(std::abs(std::log10(factor)) - 3.0) < kPower;
  const std::string which = fmt::format("{}", fmt::join(names, ", "));
  Finding finding;
  finding.shots.assign(shots.begin(), shots.end());
  finding.cause = thousand ? "unit: mW for W" : "light off by a factor";
  finding.text = fmt::format(
      "{}: {} {} times {} light{} than the stated intensities and responsivity allow for any "
      "material",
      thousand ? (factor < 1.0 ? "unit (mW for W?)" : "unit (W for mW?)") : "light off by a factor",
      all || is_of_channels ? "the shots contain" : "the shots lit by " + which + " contain",
      number(std::max(factor, 1.0 / factor)), factor < 1.0 ? "less" : "more",
      is_of_channels ? " in " + which : "");
  finding.advice = is_of_channels ? "correct " + which +
                                        " of lights.intensity_W_per_sr or of "
                                        "camera.responsivity_counts_mm2_sr_per_W_s"
                   : all ? "correct lights.intensity_W_per_sr (in W/sr) or "
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
