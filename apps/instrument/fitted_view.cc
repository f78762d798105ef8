#include "apps/instrument/fitted_view.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "core/base/chi_square.h"
#include "core/estimation/contradictions.h"
#include "core/estimation/model_choice.h"
#include "core/nuisances/view_shift.h"

namespace scattermeter::apps {
namespace {

constexpr const char* kUnsettledReason =
    "the shots do not determine from where the object is seen: its position changes from fit to "
    "fit; check the pose points and the position of its mesh, or add shots under another LED";

// Of the channel nearest to its image, as a share of it; 0 if one explains its image.
double least_misfit(const std::vector<ChannelResult>& results) {
  double least = std::numeric_limits<double>::infinity();
  for (const ChannelResult& r : results) {
    if (!r.estimate.converged) continue;
    least = std::min(least, misses_image(r.estimate) ? r.estimate.misfit_relative : 0.0);
  }
  return least;
}

// All that transport has estimated: an atlas may hold as many as another fit would use.
bool have_enough_paths(const std::vector<ChannelResult>& results) {
  return std::all_of(results.begin(), results.end(), [](const ChannelResult& r) {
    return r.model != "transport" || r.has_enough_paths;
  });
}

// Outlines hardly tell where a curved body stands.
bool any_curved(const std::vector<ObservedShot>& shots) {
  return std::any_of(shots.begin(), shots.end(), [](const ObservedShot& shot) {
    return shot.seen->patches->surface_normals().any_curved();
  });
}

}  // namespace

std::vector<ChannelResult> fitted_from_where_seen(
    const Scene& scene, SeenShots& seen, EstimateOptions options,
    const std::function<std::vector<ChannelResult>(const EstimateOptions&)>& fit,
    const std::function<bool()>& finds_elsewhere,
    const std::function<bool(const std::vector<ChannelResult>&)>& finds_leds, Stopwatch& watch) {
  // Where the dipole does not describe the medium, its misfit may move the object from fit to fit:
  // unless a view brings it so much nearer to the image, transport looks from the stated position.
  constexpr double kNearer = 0.5;
  constexpr double kUnsettled = 2.0 * kVisibleMotion;
  // Paths are traced anew for the larger motions only, beyond what the paths' own noise makes up,
  // and once.
  constexpr double kWorthPaths = 2.0 * kVisibleMotion;
  // Enough of them tell where the objects lie; the others are for the view that stays.
  constexpr std::int64_t kLookingPaths = 300'000;
  // A rig that all channels together contradict is not seen better from elsewhere.
  constexpr double kContradicted = 1e-6;
  bool by_transport = false;  // the view is where transport shows the objects to lie
  bool is_stated = false;     // the view is back where the rig says
  double misfit_before = std::numeric_limits<double>::infinity();
  double motion_before = std::numeric_limits<double>::infinity();
  for (int views = 1;; ++views) {
    const auto from = [&](const JointJudgement& joint) {
      return seen_elsewhere(scene, seen.shots(), joint.pulls, motion_before);
    };
    const bool is_last = views == kMostViews || by_transport;
    SeenElsewhere found;
    bool is_vain = false, has_found_leds = false;
    options.goes_on_from_dipole = [&](const std::vector<ChannelResult>& results) {
      if (by_transport || is_stated) return true;
      has_found_leds = finds_leds(results);
      if (has_found_leds) return false;
      found = from(any_curved(seen.shots()) ? most_probable_pulls_of(results)
                                            : joint_pulls_of(results));
      const double misfit = least_misfit(results);
      is_vain = misfit > kNearer * misfit_before || (is_last && found.motion > kUnsettled);
      misfit_before = misfit;
      if (is_vain) return false;
      // Paths are traced to all rows only.
      return !seen.levels() && (is_last || !(found.motion > kVisibleMotion));
    };
    options.looking_paths = by_transport ? std::nullopt : std::optional(kLookingPaths);
    std::vector<ChannelResult> results = fit(options);
    if (has_found_leds || (options.model == "dipole" && finds_leds(results))) return results;
    if (options.model == "dipole") found = from(most_probable_pulls_of(results));
    const bool has_paths = std::any_of(results.begin(), results.end(), [](const ChannelResult& r) {
      return r.model == "transport" && r.estimate.converged;
    });
    if (has_paths && !by_transport && !(found.motion > kVisibleMotion)) {
      const JointJudgement joint = joint_pulls_of(results);
      motion_before = std::numeric_limits<double>::infinity();
      found = from(joint);
      by_transport = true;
      if (!(found.motion > kWorthPaths) || !is_determined_elsewhere(joint.pulls) ||
          chi_square_tail(joint.chi2, joint.dof) < kContradicted) {
        found = {};
        if (!have_enough_paths(results)) {
          options.found = std::move(results);
          continue;
        }
      }
    }
    if (!is_vain && (is_last || !(found.motion > kVisibleMotion))) {
      if (!(found.motion > kUnsettled)) return results;
      for (ChannelResult& r : results) {
        if (!r.refused()) r.estimate.reasons.emplace_back(kUnsettledReason);
      }
      return results;
    }
    if (views == 1 && finds_elsewhere()) return results;
    if (by_transport) options.found = std::move(results);
    is_stated = is_vain;
    motion_before = found.motion;
    seen.open_from(is_stated ? std::map<std::string, PoseShift>() : found.shifts);
    watch.lap("shots");
  }
}

}  // namespace scattermeter::apps
