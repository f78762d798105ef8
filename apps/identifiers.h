// Names that any file format takes.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// Each name with everything but letters, digits and _ made _, and m_ before a digit or nothing; the
// second of two that become the same gets _2, and so on. Unique, in the order given.
std::vector<std::string> identifiers(const std::vector<std::string>& names);

}  // namespace scattermeter::apps
