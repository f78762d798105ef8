#include "apps/looks/first_look.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/core.h>

#include "capture/shots/pedestal.h"
#include "core/camera/channel_index.h"

namespace scattermeter::apps {
namespace {

constexpr std::size_t kMostReasons = 2;
// Of the brightest patch: a background of this brightness scatters light onto the object, and shows
// through where the mesh does not fit.
constexpr double kBrightBackground = 0.05;

bool is_of_lights(const Finding& f) {
  return f.cause == "LEDs exchanged" || f.cause.starts_with("unit");
}

}  // namespace

std::set<std::size_t> shots_of(const std::vector<Finding>& findings) {
  std::set<std::size_t> out;
  for (const Finding& f : findings) out.insert(f.shots.begin(), f.shots.end());
  return out;
}

std::vector<Finding> in_order(std::vector<Finding> of_outlines, std::vector<Finding> of_light) {
  const std::set<std::size_t> explained = shots_of(of_outlines);
  std::vector<Finding> out = std::move(of_outlines);
  for (Finding& f : of_light) {
    const bool follows = std::all_of(f.shots.begin(), f.shots.end(),
                                     [&](std::size_t s) { return explained.contains(s); });
    if (!follows || is_of_lights(f)) out.push_back(std::move(f));
  }
  return out;
}

void refuse(const Scene& scene, const std::vector<Finding>& findings, Estimation& estimation) {
  for (std::size_t i = 0; i < estimation.results.size(); ++i) {
    std::set<std::size_t> own;
    for (const ObservedShot* shot : estimation.channels[i].shots) {
      own.insert(scene.index_of(*shot->stated));
    }
    std::size_t reasons = 0;
    for (const Finding& f : findings) {
      const bool concerns = std::any_of(f.shots.begin(), f.shots.end(),
                                        [&](std::size_t s) { return own.contains(s); });
      if (!concerns || reasons++ >= kMostReasons) continue;
      estimation.results[i].estimate.reasons.push_back(f.sentence());
    }
  }
}

bool is_fitted_and_refused(const ChannelResult& result) {
  return result.refused() && result.estimate.rows > 0;
}

bool uses(const ChannelResult& result, const std::string& file) {
  return std::find(result.shots.begin(), result.shots.end(), file) != result.shots.end();
}

void add_first_reason(std::string reason, ChannelResult& result) {
  std::vector<std::string>& reasons = result.estimate.reasons;
  reasons.insert(reasons.begin(), std::move(reason));
}

void tell_of_background(const std::vector<ObservedShot>& shots,
                        std::vector<ChannelResult>& results) {
  for (ChannelResult& r : results) {
    if (!is_fitted_and_refused(r)) continue;
    const std::size_t c = channel_index(r.channel);
    double most = kBrightBackground, counts = 0.0;
    std::string file;
    for (const ObservedShot& shot : shots) {
      if (!uses(r, shot.stated->file) || shot.exposures.empty()) continue;
      const double level = shot.exposures.front().pedestal_counts[c] / capture::kPedestalShare;
      const double share = level / shot.observation.channel[c].brightest_counts;
      if (!(share > most)) continue;
      most = share;
      counts = level;
      file = shot.stated->file;
    }
    if (file.empty()) continue;
    add_first_reason(
        fmt::format("background: beside the object it is as bright in {} as {:.0f} % of the "
                    "brightest patch ({:.0f} counts above black); use a black backdrop, and keep "
                    "other light off it and off the lens",
                    file, 100.0 * most, counts),
        r);
  }
}

void tell_of_outline(const std::string& departure, std::vector<ChannelResult>& results) {
  if (departure.empty()) return;
  for (ChannelResult& r : results) {
    if (is_fitted_and_refused(r)) add_first_reason(departure, r);
  }
}

std::vector<ChannelResult> estimate_others(const Scene& scene, LitObjects& lit,
                                           const std::vector<ObservedShot>& shots,
                                           const std::vector<Finding>& findings,
                                           const EstimateOptions& options, KeptLight& kept,
                                           Stopwatch& watch, Progress* progress) {
  Estimation estimation(scene, lit, shots, material_channels(scene, shots, options.channels),
                        options, kept, watch, progress);
  refuse(scene, findings, estimation);
  const bool any = std::any_of(estimation.results.begin(), estimation.results.end(),
                               [](const ChannelResult& r) { return !r.refused(); });
  if (any || findings.empty()) run(estimator(options.model), estimation);
  return std::move(estimation.results);
}

}  // namespace scattermeter::apps
