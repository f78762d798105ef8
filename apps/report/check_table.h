// Results of a check as a table for the terminal.
#pragma once

#include <string>

#include "apps/checking/check.h"

namespace scattermeter::apps {

// One line for each item, then the number of failed checks.
std::string check_table(const CheckReport& report);

}  // namespace scattermeter::apps
