// One line of what `check` says.
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
  double std = std::numeric_limits<double>::quiet_NaN();  // not known
  // Index of the shot in the rig; npos: of no shot.
  std::size_t shot_idx = npos;
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);
};

struct CheckItem {
  std::string what;       // "pose", "clipped samples": one of its kind in the report
  std::string unit;       // of rms, worst, limit
  double rms = 0;         // over the details
  double worst = 0;       // the detail nearest to the limit or farthest beyond it, sign kept
  double limit = 0;       // of its absolute value
  bool at_least = false;  // the limit is the least, not the most
  std::string where;      // of the worst
  bool passed = true;
  std::string advice;  // what a user should do when it fails
  std::vector<CheckDetail> details;
};

struct CheckLimit {
  double value = 0;
  bool at_least = false;
  bool above_only = false;  // any value below the limit passes, however far below 0
  // A value beyond the limit counts only when it is as many deviations away from 0, too.
  double least_stds = 0;
};

// rms, worst and verdict from the details. A value that is not finite fails. Details may be empty:
// then the item passes with rms and worst NaN (nothing to judge).
CheckItem judged(const std::string& what, const std::string& unit, const CheckLimit& limit,
                 const std::string& advice, std::vector<CheckDetail> details);

}  // namespace scattermeter::apps
