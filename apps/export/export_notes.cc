#include "apps/export/export_notes.h"

#include <cmath>

#include <fmt/core.h>

namespace scattermeter::apps {
namespace {

// The text on one line: control characters become spaces.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20U || c == '\x7f') c = ' ';
  }
  return text;
}

// "1.4 +- 0.002".
std::string with_std(const Quantity& q) {
  if (!std::isfinite(q.std)) return fmt::format("{:.6g} (standard deviation not known)", q.value);
  if (is_upper_limit(q)) return fmt::format("{:.6g} (an upper limit of {:.2g})", q.value, q.high95);
  return fmt::format("{:.6g} +- {:.2g}", q.value, q.std);
}

}  // namespace

std::vector<std::string> export_notes(const ReadResult& result, const ExportOptions& options) {
  std::vector<std::string> notes;
  notes.push_back(on_one_line("Measured by scattermeter " + result.version + ": " + result.path));
  notes.push_back(
      fmt::format("Scale: 1 scene unit = {} mm (option mm-per-unit).", options.mm_per_unit));
  notes.push_back(
      options.g == 0.0
          ? "Phase function: isotropic. The measured quantity is sigma_s' = sigma_s (1 - g); where "
            "g is unknown, sigma_s = sigma_s' with g = 0 looks the same inside a thick body."
          : fmt::format(
                "Phase function: Henyey-Greenstein with g = {} as given by option g; the measured "
                "quantity is sigma_s' = sigma_s (1 - g).",
                options.g));
  notes.push_back(
      "R, G, B are the camera's own filter channels, linear, not those of a colour space. +- is "
      "one standard deviation.");
  return notes;
}

std::vector<std::string> value_notes(const MeasuredMaterial& material) {
  std::vector<std::string> notes;
  for (const ReadChannel& c : material.rgb) {
    notes.push_back(on_one_line(
        fmt::format("{} {}: sigma_s' {} per mm, sigma_a {} per mm, eta {:.6g}, model {}",
                    c.material, c.channel, with_std(c.sigma_s_prime_per_mm),
                    with_std(c.sigma_a_per_mm), c.eta_int_over_ext, c.model)));
  }
  return notes;
}

}  // namespace scattermeter::apps
