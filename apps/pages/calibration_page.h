// Results of a calibration as an HTML page.
#pragma once

#include <string>
#include <vector>

#include "apps/pages/page_plots.h"

namespace scattermeter::apps {

struct CalibrationSummary {
  std::string title;
  std::string verdict;  // a sentence: how well it is known, or what failed
  std::string next;     // a sentence: what to do with it
  bool is_ok = true;
  std::string table;  // lines of aligned columns, as on the terminal
  std::vector<PagePlot> plots;
};

std::string calibration_page(const CalibrationSummary& summary, const std::string& command_line);

// Writes the page beside the file of the calibration: camera.html beside camera.yaml. Returns a
// line for the user. Throws InputError when it cannot be written.
std::string write_page_beside(const std::string& file, const std::string& page);

}  // namespace scattermeter::apps
