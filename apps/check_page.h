// What `check` found, to look at.
#pragma once

#include <string>

#include "apps/check.h"
#include "apps/checked_rig.h"

namespace scattermeter::apps {

// A self-contained HTML page (html_page.h): the table with advice, pose residuals over the frame,
// light, black level and noise over the shots, the shots in small with what is left out marked, and
// every single value. Where gnuplot is missing, sentences stand in place of the plots.
std::string check_page(const CheckedRig& checked, const CheckReport& report,
                       const std::string& command_line);

}  // namespace scattermeter::apps
