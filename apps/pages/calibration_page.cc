#include "apps/pages/calibration_page.h"

#include <filesystem>

#include <fmt/core.h>

#include "apps/pages/html_page.h"
#include "capture/files/pending_file.h"
#include "core/base/version.h"

namespace scattermeter::apps {

std::string calibration_page(const CalibrationSummary& summary, const std::string& command_line) {
  Html body = html_element("h1", html_text(summary.title));
  body += html_element("p", html_text(summary.verdict), summary.is_ok ? "pass" : "fail");
  body += html_element("p", html_text(summary.next));
  body += html_element("p", html_text(fmt::format("{} (scattermeter {})", command_line, kVersion)),
                       "dim");
  if (!summary.plots.empty()) body += plot_figures(summary.plots);
  body += html_element("h2", html_text("Values"));
  body += html_lines(summary.table);
  return html_document(summary.title, body);
}

std::string write_page_beside(const std::string& file, const std::string& page) {
  const std::string path = std::filesystem::path(file).replace_extension(".html").string();
  capture::write_text_file(path, page);
  return "written: " + path + "\n";
}

}  // namespace scattermeter::apps
