// Values of a rig that `init` wrote and nobody has measured yet.
#pragma once

#include <string>
#include <vector>

namespace scattermeter::apps {

// Begins the comment of a line with such a value, as apps/drafting/rig_draft.h writes it.
inline constexpr const char* kPlaceholder = "# MEASURE";

// "rig.yaml: placeholders of `init` may be left (marked MEASURE in line 8, 35): ..."; "" where the
// file has no such comment or cannot be read.
std::string placeholder_note(const std::string& rig_path);

// Puts it first among the notes, if there is one.
void tell_placeholders(const std::string& rig_path, std::vector<std::string>& notes);

}  // namespace scattermeter::apps
