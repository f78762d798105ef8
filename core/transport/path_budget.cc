#include "core/transport/path_budget.h"

#include <algorithm>

namespace scattermeter {

double PathBudget::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

int PathBudget::next_blocks(int now, int least,
                            const std::function<std::int64_t(int)>& missing_paths) const {
  const double in_time = left_s() * (tracing_s_ > 0.0 ? traced_ / tracing_s_ : kUnknownPathsPerS);
  for (const int more : {2 * now, std::max(least, 3 * now / 2), 5 * now / 4}) {
    if (!(more > now && more <= most_blocks_)) continue;
    if (static_cast<double>(missing_paths(more)) <= in_time) return more;
  }
  return 0;
}

}  // namespace scattermeter
