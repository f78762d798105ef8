// Wall-clock times of the stages of a measurement.
#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace scattermeter {

// Appends (stage, seconds) to a list that outlives it; laps of one name add up.
class Stopwatch {
 public:
  explicit Stopwatch(std::vector<std::pair<std::string, double>>& timing_s) : timing_s_(timing_s) {}
  // Time since the last lap (or the start).
  void lap(const char* stage) {
    const Time now = std::chrono::steady_clock::now();
    const double lap_s = std::chrono::duration<double>(now - last_).count();
    const auto known = std::find_if(timing_s_.begin(), timing_s_.end(),
                                    [&](const auto& stage_s) { return stage_s.first == stage; });
    if (known == timing_s_.end()) {
      timing_s_.emplace_back(stage, lap_s);
    } else {
      known->second += lap_s;
    }
    last_ = now;
  }
  // Time since the start, as "total".
  void total() {
    const Time now = std::chrono::steady_clock::now();
    timing_s_.emplace_back("total", std::chrono::duration<double>(now - start_).count());
  }

 private:
  using Time = std::chrono::steady_clock::time_point;
  std::vector<std::pair<std::string, double>>& timing_s_;
  Time start_ = std::chrono::steady_clock::now();
  Time last_ = start_;
};

}  // namespace scattermeter
