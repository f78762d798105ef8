// The measurement as a table for people.
#pragma once

#include <string>

#include "apps/measure.h"

namespace scattermeter::apps {

// One line per material and channel with value ± standard deviation in 1/mm, verdict, and the
// reasons of refused ones below.
std::string result_table(const Measurement& measurement);

}  // namespace scattermeter::apps
