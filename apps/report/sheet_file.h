// Sheets as PDF or PNG, the door to Cairo.
#pragma once

#include <string>

#include "apps/drafting/board_sheet.h"

namespace scattermeter::apps {

// Writes a PDF of one page, true to scale, or a PNG of 600 dots per inch, by the end of the path
// (".pdf", ".png"). Throws InputError for another one, or when the file cannot be written.
void write_sheet(const std::string& path, const Sheet& sheet);

}  // namespace scattermeter::apps
