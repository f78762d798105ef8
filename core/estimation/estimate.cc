#include "core/estimation/estimate.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/core.h>

#include "core/base/nearest_name.h"
#include "core/base/progress.h"
#include "core/estimation/contradictions.h"
#include "core/estimation/estimation.h"

namespace scattermeter {

std::span<const Estimator> estimators() {
  static constexpr std::array<Estimator, 4> kEstimators = {{
      {"auto", "the dipole where the shots show that it holds, else transport", true,
       estimate_auto},
      {"transport", "volume Monte Carlo in the mesh", true, estimate_transport},
      {"dipole", "the dipole, fitted with all nuisances", true,
       [](Estimation& e) { estimate_dipole(e); }},
      {"paper", "the procedure of Mukaigawa, Suzuki and Yagi", false, estimate_paper},
  }};
  return kEstimators;
}

const Estimator& estimator(const std::string& name) {
  const auto all = estimators();
  const auto it =
      std::find_if(all.begin(), all.end(), [&](const Estimator& e) { return name == e.name; });
  if (it == all.end()) {
    std::vector<std::string> names;
    for (const Estimator& e : all) names.emplace_back(e.name);
    throw std::invalid_argument("no estimator has the name '" + name + "'" +
                                did_you_mean(name, names));
  }
  return *it;
}

namespace {

// Tells of refused results what their residual looks like.
void describe_residuals(Estimation& e) {
  for (ChannelResult& r : e.results) {
    if (!r.refused() || !r.look) continue;
    r.estimate.reasons.push_back(
        fmt::format("the residual is mostly {} ({:.0f} % of what noise does not explain)",
                    r.look->phrase, 100.0 * r.look->share));
  }
}

}  // namespace

void run(const Estimator& chosen, Estimation& estimation) {
  chosen.estimate(estimation);
  refuse_contradicted(estimation.results);
  describe_residuals(estimation);
}

std::vector<ChannelResult> estimate(const Scene& scene, LitObjects& lit,
                                    std::span<const ObservedShot> shots,
                                    const EstimateOptions& options, Progress* progress) {
  KeptLight kept;
  std::vector<std::pair<std::string, double>> timing_s;
  Stopwatch watch(timing_s);
  return estimate(scene, lit, shots, options, kept, watch, progress);
}

std::vector<ChannelResult> estimate(const Scene& scene, LitObjects& lit,
                                    std::span<const ObservedShot> shots,
                                    const EstimateOptions& options, KeptLight& kept,
                                    Stopwatch& watch, Progress* progress) {
  const Estimator& chosen = estimator(options.model);
  Estimation estimation(scene, lit, shots, material_channels(scene, shots, options.channels),
                        options, kept, watch, progress);
  run(chosen, estimation);
  return std::move(estimation.results);
}

}  // namespace scattermeter
