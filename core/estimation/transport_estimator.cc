// The estimators that use transport: for all channels, or for those where the dipole will not do.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include "core/base/progress.h"
#include "core/estimation/channel_simulation.h"
#include "core/estimation/estimation.h"
#include "core/estimation/model_choice.h"
#include "core/estimation/transport_search.h"
#include "core/estimation/transport_start.h"

namespace scattermeter {
namespace {

using Systems = std::vector<std::optional<DipoleSystem>>;

// The channel by transport; false, with nothing changed, where that lacks paths.
bool search_one(Estimation& e, const Systems& systems, std::size_t channel, bool may_trace,
                std::span<const ChannelResult> others, ProgressStage& stage) {
  ChannelResult result = start_from_dipole(e.results[channel]);
  if (!start_as_before(e.options.found, result)) start_like_others(others, result.estimate);
  if (!search_by_transport(e.scene, e.channels[channel], *systems[channel], *e.kept.atlas,
                           may_trace, e.options, stage, result)) {
    return false;
  }
  e.results[channel] = std::move(result);
  stage.step();
  return true;
}

// Side by side as far as the atlas has the paths: a channel of each material first, from which the
// others start. Then, one after the other, those that lack some.
void search_all(Estimation& e, const Systems& systems, std::vector<std::size_t> wanted,
                ProgressStage& stage) {
  const auto is_first = [&](std::size_t i) {
    return std::none_of(wanted.begin(), wanted.end(), [&](std::size_t j) {
      return j < i && e.channels[j].material == e.channels[i].material;
    });
  };
  // The atlas takes the first of views that are near each other: not by chance of the threads.
  for (const std::size_t i : wanted) ChannelSimulation(e.scene, e.channels[i], *e.kept.atlas);
  std::vector<char> is_found(e.channels.size(), 0);
  for (const bool first : {true, false}) {
    const std::vector<ChannelResult> others = first ? std::vector<ChannelResult>() : e.results;
    std::vector<std::size_t> now;
    std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(now),
                 [&](std::size_t i) { return is_first(i) == first; });
    tbb::parallel_for(std::size_t{0}, now.size(), [&](std::size_t k) {
      tbb::this_task_arena::isolate(
          [&] { is_found[now[k]] = search_one(e, systems, now[k], false, others, stage) ? 1 : 0; });
    });
  }
  for (const std::size_t i : wanted) {
    if (is_found[i] == 0) search_one(e, systems, i, true, e.results, stage);
  }
}

// The dipole for all channels, then transport for those that `wants_transport` chooses.
template <class Wants>
void estimate_from_dipole(Estimation& e, const char* otherwise, const Wants& wants_transport) {
  std::vector<std::optional<DipoleSystem>> systems(e.channels.size());
  estimate_dipole(e, &systems, true);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    if (!systems[i]) continue;
    e.results[i].why_transport = why_transport(e.results[i]);
    if (wants_transport(e.results[i])) wanted.push_back(i);
  }
  if (e.options.goes_on_from_dipole && !e.options.goes_on_from_dipole(e.results)) return;
  for (ChannelResult& r : e.results) r.model = otherwise;
  if (wanted.empty()) return;
  ProgressStage stage(e.progress, "transport", wanted.size());
  search_all(e, systems, wanted, stage);
  e.watch.lap("transport");
}

}  // namespace

void estimate_transport(Estimation& e) {
  estimate_from_dipole(e, "transport", [](const ChannelResult&) { return true; });
}

void estimate_auto(Estimation& e) {
  estimate_from_dipole(e, "dipole",
                       [](const ChannelResult& r) { return !r.why_transport.empty(); });
}

}  // namespace scattermeter
