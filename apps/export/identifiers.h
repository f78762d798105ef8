// Names that are valid identifiers in every file format.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// Each name with every character but letters, digits and _ replaced by _, and with the prefix m_
// when it is empty or begins with a digit. Names that become equal get the suffixes _2, _3, ... The
// result is unique and in the order of `names`.
std::vector<std::string> identifiers(const std::vector<std::string>& names);

}  // namespace scattermeter::apps
