// Assumptions behind a plan, in words.
#pragma once

#include <string>
#include <vector>

#include "apps/planning/plan.h"

namespace scattermeter::apps {

// One sentence or two for each assumption of the forecast.
std::vector<std::string> plan_assumptions(const Plan& plan);

}  // namespace scattermeter::apps
