// Results of a measurement as a table for the terminal.
#pragma once

#include <array>
#include <string>

#include "apps/instrument/measure.h"

namespace scattermeter::apps {

// One line for each material and channel with values ± standard deviations in 1/mm and the verdict,
// then the reasons of refusals.
std::string result_table(const Measurement& measurement);

// "2.193 ± 0.012", with two significant digits of the standard deviation; "< 0.0031" for an upper
// limit.
std::string value_with_deviation(const Quantity& q);

// "PE_1.dng: 2 files merged, PE_1.dng (0.2 s) in 43 % of the samples on the object, PE_1b.dng ...;
// 0.1 % clipped in all", over all channels.
std::string bracket_text(const MergedBracket& bracket);

// "2310 in use, 120 at silhouettes or creases left out, 3 clipped", from the counts of
// ChannelResult.
std::string patches_text(const std::array<std::size_t, kRowStates>& by_state, std::size_t partly);

}  // namespace scattermeter::apps
