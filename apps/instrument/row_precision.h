// How many rows (patches in shots) an answer needs.
#pragma once

#include <optional>
#include <span>

#include "core/estimation/channel_result.h"

namespace scattermeter::apps {

// The standard deviations that suffice, relative to the values.
struct PrecisionGoal {
  double sigma_s_prime = 0;
  double sigma_a = 0;
};

// Levels of the choice of rows (core/view/chosen_rows.h) from which a measurement begins: 1024 rows
// of each view.
inline constexpr int kFirstLevels = 10;

// From the dipole's results on the rows of `levels`, `all_rows` times as many of which there are:
// the levels with which every channel is forecast to reach the goal and to show a thousandth of the
// image if the dipole missed it; `levels` where they suffice. Absent: all rows; also where a
// channel is refused, its shots disagree or it wants transport, as what speaks against an answer is
// judged by all that there is.
std::optional<int> levels_needed(std::span<const ChannelResult> results, const PrecisionGoal& goal,
                                 int levels, double all_rows);

}  // namespace scattermeter::apps
