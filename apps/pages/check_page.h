// Results of a check as an HTML page.
#pragma once

#include <string>

#include "apps/checking/check.h"
#include "apps/checking/checked_rig.h"

namespace scattermeter::apps {

// A self-contained HTML page (html_page.h): the table with advice, the rig in three dimensions,
// pose residuals over the frame, light, black level and noise over the shots, small pictures of the
// shots with clipped samples marked, and all single values.
std::string check_page(const CheckedRig& checked, const CheckReport& report,
                       const std::string& command_line);

}  // namespace scattermeter::apps
