// A file under a second name.
#pragma once

#include <string>

namespace scattermeter::apps {

// A second name of the file, or a copy on another disk; what was there is replaced, and missing
// folders are made. Throws InputError naming `to` where it cannot be written.
void link_or_copy(const std::string& from, const std::string& to);

}  // namespace scattermeter::apps
