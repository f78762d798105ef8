// Paths that a search by Monte Carlo may still trace.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

namespace scattermeter {

// By the number of blocks of paths, and by time at the speed so far. Time counts from the
// construction.
class PathBudget {
 public:
  PathBudget(double most_blocks, double time_limit_s)
      : most_blocks_(most_blocks),
        time_limit_s_(time_limit_s),
        start_(std::chrono::steady_clock::now()) {}

  // The speed that counts before any path has been traced, as of two cores.
  static constexpr double kUnknownPathsPerS = 1e5;

  // The same, time used included, with another number of blocks.
  PathBudget with(double most_blocks) const {
    PathBudget out = *this;
    out.most_blocks_ = most_blocks;
    return out;
  }
  double elapsed_s() const;
  double left_s() const { return time_limit_s_ - elapsed_s(); }
  void count(std::int64_t paths, double seconds) {
    traced_ += static_cast<double>(paths);
    if (paths > 0) tracing_s_ += seconds;
  }
  // Twice as many blocks as now, or as few as a quarter more, but then `least` if there is room for
  // them; 0: there is not even room for a quarter more, or, where most of at least `least` blocks
  // had been traced before this search, for half as many: they would hardly tell more.
  // missing_paths: to be traced for so many.
  int next_blocks(int now, int least,
                  const std::function<std::int64_t(int blocks)>& missing_paths) const;
  // With how many blocks, up to `most`, a search that has `now` can expect to end at this point.
  int final_blocks(int now, int least, int most,
                   const std::function<std::int64_t(int blocks)>& missing_paths) const;
  // Whether so many fit into `limits` times the time limit.
  bool has_time_for(std::int64_t paths, double limits = 1.0) const;

 private:
  double most_blocks_, time_limit_s_;
  std::chrono::steady_clock::time_point start_;
  double traced_ = 0, tracing_s_ = 0;  // paths, and the time that they took
};

}  // namespace scattermeter
