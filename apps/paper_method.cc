// --model paper: the paper's procedure, for comparison.
#include <fmt/core.h>

#include "apps/estimation_task.h"
#include "core/paper_estimator.h"

namespace scattermeter::apps {

void estimate_paper(Estimation& e) {
  const DistanceKnots knots = smooth_knots(e.library);
  std::vector<std::vector<PaperAnswer>> answers(e.tasks.size());
  const std::vector<double> widths = paper_widths_mm();
  for (std::size_t w = 0; w < widths.size(); ++w) {
    const UniformBins bins(widths[w], e.library.longest_distance_mm());
    Weights weights;
    add_weights(
        e.shots, e.library, true,
        [&](const SeenObject& seen, const SourceCloud& sources) {
          return uniform_weights(seen.sites, sources, bins, pair_options(knots));
        },
        weights);
    for_open_tasks(fmt::format("width {:.2f} mm", widths[w]), e, [&](std::size_t i) {
      const DenseSystem system =
          system_of(e.rig, e.tasks[i], rows_of(e.rig, e.tasks[i]), weights, 0.0);
      if (system.l.size() > 0) {
        answers[i].push_back(solve_paper(system, widths[w], e.tasks[i].eta));
      }
    });
  }
  for (std::size_t i = 0; i < e.tasks.size(); ++i) {
    if (e.results[i].refused()) continue;
    report_rows(e.tasks[i], rows_of(e.rig, e.tasks[i]), e.results[i]);
    if (answers[i].empty()) {
      e.results[i].estimate.reasons.push_back("no patch can be used");
    } else {
      e.results[i].estimate = choose_width(answers[i]);
    }
  }
  e.watch.lap("fit");
}

}  // namespace scattermeter::apps
