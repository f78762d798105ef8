// Paths that a search by transport may still trace.
#pragma once

#include <chrono>
#include <cstdint>

#include "core/estimation/channel_simulation.h"
#include "core/estimation/estimation.h"

namespace scattermeter {

// By options.paths, for each light and view, and by options.time_limit_s at the speed so far. Time
// counts from the construction. The options must outlive the object.
class PathBudget {
 public:
  explicit PathBudget(const EstimateOptions& options)
      : options_(options), start_(std::chrono::steady_clock::now()) {}

  double elapsed_s() const;
  double left_s() const { return options_.time_limit_s - elapsed_s(); }
  void count(std::int64_t paths, double seconds) {
    traced_ += static_cast<double>(paths);
    if (paths > 0) tracing_s_ += seconds;
  }
  // Twice as many blocks as now, or as few as a quarter more; 0: there is not even room for those.
  int next_blocks(const ChannelSimulation& simulation, const ScatteringPoint& at, int now) const;

 private:
  const EstimateOptions& options_;
  std::chrono::steady_clock::time_point start_;
  double traced_ = 0, tracing_s_ = 0;  // paths, and the time that they took
};

}  // namespace scattermeter
