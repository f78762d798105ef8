// Predicted uncertainties of planned shots as an HTML page.
#pragma once

#include <string>

#include "apps/planning/plan.h"

namespace scattermeter::apps {

// A self-contained HTML page (apps/pages/html_page.h): the predicted uncertainties with their
// budget, the rig in three dimensions, exposures, improvements, maps of LED positions, and the
// assumptions.
std::string plan_page(const Plan& plan, const std::string& command_line);

}  // namespace scattermeter::apps
