// Values of a rig that `init` wrote and nobody has measured yet.
#pragma once

#include <string>

namespace scattermeter::apps {

// Begins the comment of a line with such a value, as apps/drafting/rig_draft.h writes it.
inline constexpr const char* kPlaceholder = "# MEASURE";

// "rig.yaml: lines 8, 35 and 37 are marked MEASURE ..."; "" where the file has no such comment or
// cannot be read.
std::string placeholder_note(const std::string& rig_path);

}  // namespace scattermeter::apps
