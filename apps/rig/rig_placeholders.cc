#include "apps/rig/rig_placeholders.h"

#include <fstream>
#include <utility>

#include <fmt/format.h>

namespace scattermeter::apps {

std::string placeholder_note(const std::string& rig_path) {
  std::ifstream in(rig_path);
  std::vector<int> lines;
  int number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    if (line.find(kPlaceholder) != std::string::npos) lines.push_back(number);
  }
  if (lines.empty()) return "";
  return fmt::format(
      "{}: placeholders of `init` may be left (marked MEASURE in line {}): replace them by what "
      "your rig is, and delete the marks",
      rig_path, fmt::join(lines, ", "));
}

void tell_placeholders(const std::string& rig_path, std::vector<std::string>& notes) {
  if (std::string note = placeholder_note(rig_path); !note.empty()) {
    notes.insert(notes.begin(), std::move(note));
  }
}

}  // namespace scattermeter::apps
