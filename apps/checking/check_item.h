// One line of a check's report.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace scattermeter::apps {

// A value behind the line: of a shot, a channel, a light.
struct CheckDetail {
  std::string where;  // "PP_cube_1.dng G"
  double value = 0;
  double std = std::numeric_limits<double>::quiet_NaN();  // NaN: unknown
  // Index of the shot in the rig; npos: not about a shot.
  std::size_t shot_idx = npos;
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
};

struct CheckItem {
  std::string what;       // "pose", "clipped": unique in the report
  std::string unit;       // of rms, worst, limit
  double rms = 0;         // over the details
  double worst = 0;       // the detail nearest to the limit or farthest beyond it, with its sign
  double limit = 0;       // of its absolute value
  bool at_least = false;  // the limit is a lower one
  std::string where;      // of the worst
  bool passed = true;
  std::string advice;  // what a user should do when it fails
  std::vector<CheckDetail> details;
};

struct CheckLimit {
  double value = 0;
  bool at_least = false;
  bool above_only = false;  // any value below the limit passes, however far below 0
  // A value beyond the limit fails only if it also differs from 0 by this many deviations.
  double least_stds = 0;
};

// Computes rms, worst and verdict from the details. A value that is not finite fails. Without
// details the item passes with NaN as rms and worst.
CheckItem judged(const std::string& what, const std::string& unit, const CheckLimit& limit,
                 const std::string& advice, std::vector<CheckDetail> details);

}  // namespace scattermeter::apps
