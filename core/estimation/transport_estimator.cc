// The estimators that use transport: for all channels, or for those where the dipole will not do.
#include <optional>
#include <utility>
#include <vector>

#include "core/base/progress.h"
#include "core/estimation/estimation.h"
#include "core/estimation/model_choice.h"
#include "core/estimation/transport_search.h"
#include "core/estimation/transport_start.h"

namespace scattermeter {
namespace {

// The dipole for all channels, then transport for those that `wants_transport` chooses.
template <class Wants>
void estimate_from_dipole(Estimation& e, const char* otherwise, const Wants& wants_transport) {
  std::vector<std::optional<DipoleSystem>> systems(e.channels.size());
  estimate_dipole(e, &systems);
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
  for (const std::size_t i : wanted) {
    ChannelResult& result = e.results[i];
    Estimate of_dipole = result.estimate;
    if (!start_as_before(e.options.found, result)) start_like_others(e.results, result.estimate);
    result.model = "transport";
    result.dipole = std::move(of_dipole);
    result.rows.clear();
    search_by_transport(e.scene, e.channels[i], *systems[i], *e.kept.atlas, e.options, stage,
                        result);
    stage.step();
  }
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
