#include "core/transport/path_budget.h"

#include <algorithm>

namespace scattermeter {

double PathBudget::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool PathBudget::has_time_for(std::int64_t paths, double limits) const {
  const double speed = tracing_s_ > 0.0 ? traced_ / tracing_s_ : kUnknownPathsPerS;
  return static_cast<double>(paths) <= speed * (limits * time_limit_s_ - elapsed_s());
}

int PathBudget::next_blocks(int now, int least,
                            const std::function<std::int64_t(int)>& missing_paths) const {
  const bool has_found_most =
      now >= least && traced_ < 0.5 * static_cast<double>(missing_paths(2 * now));
  for (const int more : {2 * now, std::max(least, 3 * now / 2), 5 * now / 4}) {
    if (!(more > now && more <= most_blocks_)) continue;
    if (has_found_most && more < 3 * now / 2) break;
    if (has_time_for(missing_paths(more))) return more;
  }
  return 0;
}

int PathBudget::final_blocks(int now, int least, int most,
                             const std::function<std::int64_t(int)>& missing_paths) const {
  int out = now;
  for (int more = now; more > 0 && out < most;) {
    more = next_blocks(out, least, missing_paths);
    out = std::max(out, std::min(more, most));
  }
  return out;
}

}  // namespace scattermeter
