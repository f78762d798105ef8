// The measurement as a table for people.
#pragma once

#include <array>
#include <string>

#include "apps/measure.h"

namespace scattermeter::apps {

// One line per material and channel with value ± standard deviation in 1/mm, verdict, and the
// reasons of refused ones below.
std::string result_table(const Measurement& measurement);

// "2.193 ± 0.012": as many decimals as two digits of the deviation need.
std::string value_with_deviation(const Quantity& q);

// "PE_1.dng: 2 files merged, PE_1.dng (0.2 s) in 43 % of the samples on the object, PE_1b.dng ...;
// 0.1 % clipped in all": channels together.
std::string bracket_text(const MergedBracket& bracket);

// "2310 in use, 120 at silhouettes or creases left out, 3 clipped": ChannelResult's counts.
std::string patches_text(const std::array<std::size_t, kRowStates>& by_state, std::size_t partly);

}  // namespace scattermeter::apps
