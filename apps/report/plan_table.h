// A plan as text for the terminal.
#pragma once

#include <string>

#include "apps/planning/plan.h"

namespace scattermeter::apps {

std::string plan_table(const Plan& plan);

}  // namespace scattermeter::apps
