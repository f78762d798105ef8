// --model paper: the paper's procedure, for comparison.
#include <fmt/core.h>

#include "core/estimation/estimation.h"
#include "core/fit/paper_estimator.h"

namespace scattermeter {

void estimate_paper(Estimation& e) {
  for (ChannelResult& result : e.results) result.model = "paper";
  const DistanceKnots knots = smooth_knots(e.lit);
  std::vector<std::vector<PaperEstimate>> estimates(e.channels.size());
  const std::vector<double> widths = paper_widths_mm();
  for (std::size_t w = 0; w < widths.size(); ++w) {
    const UniformBins bins(widths[w], e.lit.longest_distance_mm());
    Weights weights;
    add_weights(
        e.scene, e.shots, e.lit, nullptr,
        [&](const SeenObject& seen, const SourceCloud& sources) {
          return uniform_weights(seen.sites, sources, bins, pair_options(knots));
        },
        weights);
    e.for_open_channels(fmt::format("width {:.2f} mm", widths[w]), [&](std::size_t i) {
      const DenseSystem system = channel_system(e.scene, e.channels[i],
                                                channel_rows(e.scene, e.channels[i]), weights, 0.0);
      if (system.l.size() > 0) {
        estimates[i].push_back(solve_paper(system, widths[w], e.channels[i].eta_int_over_ext));
      }
    });
  }
  for (std::size_t i = 0; i < e.channels.size(); ++i) {
    if (e.results[i].refused()) continue;
    report_rows(e.channels[i], channel_rows(e.scene, e.channels[i]), e.results[i]);
    if (estimates[i].empty()) {
      e.results[i].estimate.reasons.push_back("no patch can be used");
    } else {
      e.results[i].estimate = choose_width(estimates[i]);
    }
  }
  e.refuse_rough_surfaces();
  e.watch.lap("fit");
}

}  // namespace scattermeter
