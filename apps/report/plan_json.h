// A plan as JSON.
#pragma once

#include <string>

#include "apps/planning/plan.h"

namespace scattermeter::apps {

std::string plan_json(const Plan& plan, const std::string& command_line);

}  // namespace scattermeter::apps
