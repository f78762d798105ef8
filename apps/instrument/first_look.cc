#include "apps/instrument/first_look.h"

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

constexpr std::size_t kMostReasons = 2;

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

void tell_of_outline(const std::string& shift, std::vector<ChannelResult>& results) {
  if (shift.empty()) return;
  for (ChannelResult& r : results) {
    if (!is_fitted_and_refused(r)) continue;
    std::vector<std::string>& reasons = r.estimate.reasons;
    reasons.insert(reasons.begin(),
                   fmt::format("pose or position: the outlines stand {} of where pose and mesh put "
                               "them; take the pose points again, or place the mesh where the "
                               "object stands",
                               shift));
  }
}

}  // namespace scattermeter::apps
