// Results of a check as JSON.
#pragma once

#include <string>

#include "apps/checking/check.h"

namespace scattermeter::apps {

// The text of check.json: every item with its details.
std::string check_json(const CheckReport& report, const std::string& command_line);

}  // namespace scattermeter::apps
