// The plan as a page.
#pragma once

#include <string>

#include "apps/plan.h"

namespace scattermeter::apps {

// Self-contained HTML (apps/html_page.h): the forecast with its budget, exposures, what would help,
// maps of LED positions, what is taken for granted.
std::string plan_page(const Plan& plan, const std::string& command_line);

}  // namespace scattermeter::apps
