#include "core/estimation/path_budget.h"

#include <algorithm>
#include <limits>

#include "core/estimation/transport_verdict.h"

namespace scattermeter {

double PathBudget::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

int PathBudget::next_blocks(const ChannelSimulation& simulation, const ScatteringPoint& at,
                            int now) const {
  const double in_time =
      tracing_s_ > 0.0 ? traced_ / tracing_s_ * left_s() : std::numeric_limits<double>::infinity();
  const double most = static_cast<double>(options_.paths) / ChannelSimulation::kBlockPaths;
  for (const int more : {2 * now, std::max(kLeastBlocks, 3 * now / 2), 5 * now / 4}) {
    if (!(more > now && more <= most)) continue;
    if (static_cast<double>(simulation.missing_paths(at, more)) <= in_time) return more;
  }
  return 0;
}

}  // namespace scattermeter
